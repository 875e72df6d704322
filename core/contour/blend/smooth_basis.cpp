#include "core/contour/blend/smooth_basis.hpp"

namespace bahnwerk::blending {

std::vector<double> clamped_knots(const std::vector<double>& breaks) {
  std::vector<double> knots(spline_degree, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), spline_degree, breaks.back());
  return knots;
}

BasisRow basis_at(const std::vector<double>& knots, std::size_t span, double t) {
  return bspline_basis<spline_order>(knots, spline_degree, span + spline_degree, t);
}

BasisRow second_derivative_basis_at(const std::vector<double>& knots, std::size_t span, double t) {
  return bspline_basis<spline_order, 2>(knots, spline_degree, span + spline_degree, t);
}

BasisRow value_basis_at(const std::vector<double>& knots, std::size_t span, double t) {
  return bspline_basis<spline_order, 0>(knots, spline_degree, span + spline_degree, t);
}

}  // namespace bahnwerk::blending
