#pragma once
/// A smooth curve near a row of points: a spline of least largest distance.
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

struct PointFit {
  std::vector<Vec> at;   ///< place on the curve that belongs to each point, mm
  std::vector<Vec> off;  ///< from the curve to the point, across the curve, mm
};

/// Fits a spline of degree 5, four times continuously differentiable, with knots at the points `knots` (indices into
/// `points`, ascending, the first and the last point among them), by weighted least squares. Weights are multiplied by
/// the distances that they leave [Lawson 1961], and parameters, `along` at first, are moved to where the curve is
/// nearest to the point, until the largest distance is a tenth of `radius` or hardly becomes less. `begin_given`,
/// `end_given`: the curve begins or ends at the point itself. O(points), about 5 µs each.
PointFit fit_points(const std::vector<Vec>& points, std::vector<double> along, double radius,
                    const std::vector<std::size_t>& knots, bool begin_given, bool end_given);

}  // namespace bahnwerk
