#pragma once
/// A smooth curve near a row of points: a smoothing spline within a distance.
#include <array>
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

struct PointFit {
  std::vector<Vec> at;                         ///< place on the curve that belongs to each point, mm
  std::vector<Vec> off;                        ///< from the curve to the point, across the curve, mm
  std::vector<double> along;                   ///< parameter of each place
  std::vector<std::array<Vec, 3>> derivative;  ///< derivatives of the curve there by the parameter, orders 1 to 3
};

/// Fits a spline of degree 5, four times continuously differentiable, over `along`, about the length, with knots from
/// that of the first point to that of the last one. It is about the one of least fourth derivatives at the knots whose
/// distances from the points are less than `radius`: the sum of the squares of these derivatives and of a power of the
/// distances relative to `radius` is made small by Newton's method, with powers from 2 to 100. Parameters are moved to
/// where the curve is nearest to the point, and only distances across the curve count (tangent distance minimisation),
/// so that spacing may be uneven. `begin_given`, `end_given`: the curve begins or ends at the point itself.
/// O(points), about 10 µs each.
PointFit fit_points(const std::vector<Vec>& points, std::vector<double> along, double radius,
                    const std::vector<double>& knots, bool begin_given, bool end_given);

}  // namespace bahnwerk
