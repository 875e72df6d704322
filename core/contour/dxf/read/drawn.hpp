#pragma once
/// Curves of a drawing before they become a contour: lines, elliptic arcs, splines, in the drawing's unit or in mm.
/// They can be mapped by any affine map, reversed, compared and measured. All values are exact images of the drawn
/// ones; nothing is approximated. O(degree) or O(points) each.
#include <cstddef>
#include <variant>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// The map p ↦ x p.x + y p.y + z p.z + origin.
struct Affine {
  Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};
  Vec direction(Vec d) const { return d.x * x + d.y * y + d.z * z; }
  Vec point(Vec p) const { return direction(p) + origin; }
  /// Returns the map that applies `inner` first.
  Affine operator*(const Affine& inner) const {
    return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin)};
  }
};

/// A straight line.
struct DrawnLine {
  Vec from, to;
};
/// The elliptic arc p(φ) = centre + a cos φ + b sin φ from φ = start over `sweep` (rad, may be negative). a, b are
/// conjugate half-axes: an affine map of the arc maps only them and the centre.
struct DrawnArc {
  Vec centre, a, b;
  double start = 0, sweep = 0;
  Vec at(double angle) const { return centre + std::cos(angle) * a + std::sin(angle) * b; }
  bool circular() const;  ///< half-axes equal and perpendicular to 1e-9
};
/// A NURBS that core/geometry/curve/nurbs.hpp accepts, with its ends and end directions.
struct DrawnSpline {
  std::size_t degree = 0;
  std::vector<Vec> points;
  std::vector<double> weights, knots;  ///< no weights: all are 1
  Vec from, to, from_direction, to_direction;
};
using Drawn = std::variant<DrawnLine, DrawnArc, DrawnSpline>;

/// Throws InvalidInput as Nurbs does.
DrawnSpline drawn_spline(std::size_t degree, std::vector<Vec> points, std::vector<double> weights,
                         std::vector<double> knots);
/// Returns an elliptic arc as rational quadratic pieces of at most a quarter turn, the exact affine image of the
/// circle's [Piegl, Tiller: The NURBS Book, 7.3].
DrawnSpline drawn_spline(const DrawnArc& arc);

Vec first_point(const Drawn& curve);
Vec last_point(const Drawn& curve);
/// These return unit tangents in the direction of travel, and 0 for a curve without length.
Vec first_direction(const Drawn& curve);
Vec last_direction(const Drawn& curve);
/// Returns an upper bound on the length: of the control polygon, or of the circle of the larger half-axis.
double extent(const Drawn& curve);
/// Returns the point at a share 0 … 1 of the parameter.
Vec point_at(const Drawn& curve, double share);
/// Returns an upper bound on the difference of the highest and lowest z.
double rise(const Drawn& curve);
/// Returns whether all coordinates are finite and within 1e9 (mm).
bool within_range(const Drawn& curve);

Drawn reversed(Drawn curve);
Drawn mapped(const Affine& map, Drawn curve);

}  // namespace bahnwerk
