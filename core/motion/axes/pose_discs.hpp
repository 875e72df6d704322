#pragma once
/// Enclosures of a tool's pose and its derivatives over an interval of its path.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/geometry/path/path.hpp"
#include "core/machine/tool.hpp"
#include "core/motion/axes/orientation.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// Immutable and thread-safe.
class PoseDiscs {
 public:
  /// Reads `tool` and shares `orientation`, which may be empty: then the angles are 0.
  PoseDiscs(const Path& tool, std::shared_ptr<const Orientation> orientation);

  /// Encloses the pose with its derivatives by arc length for all complex parameters within `radius` of u, on the
  /// segment's curve and its analytic continuation. Returns false if no enclosure is known, as where the parametric
  /// tangent may vanish. O(degree²), 1 to 2 µs.
  bool enclose(const Segment& segment, std::size_t index, double u, double radius, ToolDiscs& tool) const;

 private:
  /// The rational curve origin + N(t)/w(t) with t = (u − pivot)/reach.
  struct Quotient {
    std::array<Polynomial, 3> position;
    Polynomial weight;
    Vec origin;
    double pivot = 0, reach = 1;
  };
  std::shared_ptr<const Orientation> orientation_;
  std::vector<std::unique_ptr<const Quotient>> quotients_;  ///< one per segment; empty for lines and arcs
};

}  // namespace bahnwerk
