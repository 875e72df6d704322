#pragma once
/// Curves as a drawing has them, before they become a contour: lines, elliptic arcs, splines, in the drawing's own unit
/// or in mm. They can be mapped by any affine map, turned round, compared and measured. All values are exact images of
/// what was drawn; nothing is approximated. O(degree) or O(points) each.
#include <cstddef>
#include <variant>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// p ↦ x p.x + y p.y + z p.z + origin.
struct Affine {
  Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};
  Vec direction(Vec d) const { return d.x * x + d.y * y + d.z * z; }
  Vec point(Vec p) const { return direction(p) + origin; }
  /// First `inner`, then this.
  Affine operator*(const Affine& inner) const {
    return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
  }
};

struct DrawnLine {
  Vec from, to;
};
/// p(φ) = centre + a cos φ + b sin φ from φ = start over `sweep` (rad, may be negative). a, b are conjugate half-axes:
/// an affine map of the arc maps them and the centre alone.
struct DrawnArc {
  Vec centre, a, b;
  double start = 0, sweep = 0;
  Vec at(double angle) const { return centre + std::cos(angle) * a + std::sin(angle) * b; }
  bool circular() const;  ///< half-axes equal and perpendicular to 1e-9
};
/// A NURBS that core/geometry/curve/nurbs.hpp accepts; ends and end directions are kept beside it.
struct DrawnSpline {
  std::size_t degree = 0;
  std::vector<Vec> points;
  std::vector<double> weights, knots;  ///< no weights = all one
  Vec from, to, from_direction, to_direction;
};
using Drawn = std::variant<DrawnLine, DrawnArc, DrawnSpline>;

/// Throws InvalidInput as Nurbs does.
DrawnSpline drawn_spline(std::size_t degree, std::vector<Vec> points, std::vector<double> weights,
                         std::vector<double> knots);
/// An elliptic arc as rational quadratic pieces of at most a quarter turn, exact [Piegl, Tiller: The NURBS Book, 7.3]:
/// the affine image of the circle's.
DrawnSpline drawn_spline(const DrawnArc& arc);

Vec first_point(const Drawn& curve);
Vec last_point(const Drawn& curve);
/// Unit tangents in the direction of travel; 0 for a curve without length.
Vec first_direction(const Drawn& curve);
Vec last_direction(const Drawn& curve);
/// An upper bound on the length: of the control polygon, of the greater half-axes' circle.
double extent(const Drawn& curve);
/// Point at a share 0 … 1 of the parameter.
Vec point_at(const Drawn& curve, double share);
/// Lowest and highest z are this far apart, at most.
double rise(const Drawn& curve);
/// All coordinates finite and within 1e9 (mm).
bool within_range(const Drawn& curve);

Drawn reversed(Drawn curve);
Drawn mapped(const Affine& map, Drawn curve);

}  // namespace bahnwerk
