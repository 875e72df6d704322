#include "core/redundant/iterative/spline_space.hpp"

#include <stdexcept>
#include <utility>

#include "core/geometry/curve/bspline_basis.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t limit = max_spline_degree + 1;

}  // namespace

SplineSpace::SplineSpace(std::size_t degree, std::vector<double> knots) : degree_(degree), knots_(std::move(knots)) {
  if (degree < 1 || degree > max_spline_degree || knots_.size() < 2 * degree + 2)
    throw std::invalid_argument("a spline has a degree of 1 to 5 and clamped knots");
}

double SplineSpace::greville(std::size_t i) const {
  double sum = 0;
  for (std::size_t k = 1; k <= degree_; ++k) sum += knots_[i + k];
  return sum / static_cast<double>(degree_);
}

void SplineSpace::values(std::size_t span, double t, double* out) const {
  const double* knots = knots_.data() + span;
  switch (degree_) {  // unrolled
    case 1:
      return bspline_values<1>(knots, t, out);
    case 2:
      return bspline_values<2>(knots, t, out);
    case 3:
      return bspline_values<3>(knots, t, out);
    case 4:
      return bspline_values<4>(knots, t, out);
    default:
      return bspline_values<5>(knots, t, out);
  }
}

SplineRow SplineSpace::at(double t, std::size_t order, std::size_t& span) const {
  span = this->span(t, span);
  SplineRow row{span - degree_, degree_ + 1, {}};
  if (order == 0)
    values(span, t, row.weights.data());
  else if (order <= degree_)
    row.weights = bspline_basis<limit>(knots_, degree_, span, t)[order];
  return row;
}

bool SplineSpace::control(std::size_t order, std::size_t i, SplineRow& row) const {
  row = {i, order + 1, {}};
  // Triangle of differences: the stencil r of order o covers the control points i + r … i + r + o.
  std::array<std::array<double, limit>, limit> stencil{};
  for (std::size_t r = 0; r <= order; ++r) stencil[r][r] = 1;
  for (std::size_t o = 1; o <= order; ++o)
    for (std::size_t r = 0; r + o <= order; ++r) {
      const double width = knots_[i + r + degree_ + 1] - knots_[i + r + o];
      if (!(width > 0)) return false;
      const double factor = static_cast<double>(degree_ + 1 - o) / width;
      for (std::size_t c = 0; c <= order; ++c) stencil[r][c] = factor * (stencil[r + 1][c] - stencil[r][c]);
    }
  for (std::size_t c = 0; c <= order; ++c) row.weights[c] = stencil[0][c];
  return true;
}

TimeSpline SplineSpace::spline(const std::vector<double>& controls) const {
  TimeSpline s;
  for (std::size_t k = degree_; k < size(); ++k) {
    if (!(knots_[k + 1] > knots_[k])) continue;
    // Derivatives at the left end of the span follow from differences of its control points.
    TimeSpline::Coefficients d{}, c{};
    for (std::size_t r = 0; r <= degree_; ++r) d[r] = controls[k - degree_ + r];
    const auto value = [&](std::size_t order) {  // de Boor on the control points of the derivative
      TimeSpline::Coefficients p = d;
      const std::size_t degree = degree_ - order;
      for (std::size_t o = 1; o <= degree; ++o)
        for (std::size_t r = degree; r >= o; --r) {
          const std::size_t j = k - degree + r;
          const double w = (knots_[k] - knots_[j]) / (knots_[j + 1 + degree - o] - knots_[j]);
          p[r] = (1 - w) * p[r - 1] + w * p[r];
        }
      return p[degree];
    };
    double factorial = 1;
    for (std::size_t o = 0; o <= degree_; ++o) {
      c[o] = value(o) / factorial;
      factorial *= static_cast<double>(o + 1);
      const std::size_t degree = degree_ - o;  // degree of what d holds now
      for (std::size_t r = 0; r < degree; ++r) {
        const std::size_t j = k - degree + r + 1;
        d[r] = static_cast<double>(degree) * (d[r + 1] - d[r]) / (knots_[j + degree] - knots_[j]);
      }
    }
    s.append(knots_[k + 1] - knots_.front(), c);
  }
  return s;
}

}  // namespace bahnwerk
