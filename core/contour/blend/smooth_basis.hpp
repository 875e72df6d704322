#pragma once
/// B-splines of degree 5: values and three derivatives of the six that do not vanish at a place.
#include <cstddef>
#include <vector>

#include "core/geometry/curve/bspline_basis.hpp"

namespace bahnwerk::blending {

inline constexpr std::size_t spline_degree = 5;
inline constexpr std::size_t spline_order = spline_degree + 1;

/// [k][i]: k-th derivative of the i-th of the six.
using BasisRow = BsplineBasis<spline_order>;

/// The breaks with both ends six times: four continuous derivatives inside, position at the ends.
std::vector<double> clamped_knots(const std::vector<double>& breaks);

/// Basis functions span … span + 5 at t in [breaks[span], breaks[span + 1]]. O(degree²).
BasisRow basis_at(const std::vector<double>& knots, std::size_t span, double t);
/// The same without the derivatives of order 2 and 3, or without any, which stay 0: in a third or a fifth of the time.
BasisRow slope_basis_at(const std::vector<double>& knots, std::size_t span, double t);
BasisRow value_basis_at(const std::vector<double>& knots, std::size_t span, double t);

}  // namespace bahnwerk::blending
