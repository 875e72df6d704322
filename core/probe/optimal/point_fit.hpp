#pragma once
/// A smooth curve near a row of points: a cubic spline of least largest distance, relative to a radius of each point.
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

struct PointFit {
  std::vector<Vec> at;           ///< place on the curve that belongs to each point, mm
  std::vector<double> distance;  ///< distance of the point from it relative to its radius
};

/// Fits a spline of degree 3, twice continuously differentiable, with knots at the points `knots` (indices into
/// `points`, ascending, the first and the last point among them), by weighted least squares. Weights are multiplied by
/// the distances that they leave [Lawson 1961], and parameters, lengths of the polygon at first, are moved to where the
/// curve is nearest to the point. `radius` is positive. `begin_given`, `end_given`: the curve begins or ends at the
/// point itself. O(points), about 20 µs each.
PointFit fit_points(const std::vector<Vec>& points, const std::vector<double>& radius,
                    const std::vector<std::size_t>& knots, bool begin_given, bool end_given);

}  // namespace bahnwerk
