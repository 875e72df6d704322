#pragma once
/// Round enamelled winding wires of copper after IEC 60317-0-1.
#include <optional>
#include <vector>

namespace bahnwerk::winding {

struct Wire {
  double copper = 0;     ///< nominal diameter of the conductor, mm
  double outer = 0;      ///< largest overall diameter, mm
  double tolerance = 0;  ///< ε_D: largest minus smallest overall diameter, as a fraction of the largest

  double radius() const { return outer / 2; }
};

enum class Series { r20, r40 };

/// Returns the grade, 1 to 3, whose increase of the diameter by the enamel is nearest to the wire's, by the standard
/// wires with the nearest copper diameter.
int nearest_grade(const Wire& wire);

/// Returns the standard's wire of this nominal diameter in grade 1, 2 or 3; nothing if it has none.
std::optional<Wire> standard_wire(double copper, int grade);
/// Returns all standard wires with a nominal diameter from `least` to `most`, mm, thinnest first. The R 20 series is
/// the preferred one; R 40 has the sizes between as well.
std::vector<Wire> standard_wires(int grade, double least, double most, Series series);

}  // namespace bahnwerk::winding
