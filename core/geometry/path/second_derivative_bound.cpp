#include "core/geometry/path/second_derivative_bound.hpp"

#include <cmath>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {

namespace {

/// Bounds of |p|, |p'| and |p''| over |x| ≤ 1 from the coefficients.
std::array<double, 3> sizes(const Polynomial& p) {
  std::array<double, 3> sum{};
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double c = std::abs(p[k]), n = static_cast<double>(k);
    sum[0] += c;
    sum[1] += n * c;
    sum[2] += n * (n - 1) * c;
  }
  return sum;
}

}  // namespace

SecondDerivativeBound::SecondDerivativeBound(const Curve& curve) : curve_(&curve) {
  if (curve.kind() == CurveKind::arc) {
    const auto& arc = static_cast<const Arc&>(curve);
    constant_ = arc.radius() * arc.sweep() * arc.sweep();
  } else if (curve.kind() == CurveKind::rational) {
    rational_ = true;
    weighted_ = static_cast<const Rational&>(curve).rational();
  }
}

double SecondDerivativeBound::at(double u0, double u1) const {
  if (!rational_) return constant_;
  const auto& curve = static_cast<const Rational&>(*curve_);
  // The variable is t = middle + half·x, |x| ≤ 1.
  const double middle = (0.5 * (u0 + u1) - curve.pivot()) / curve.reach(), half = 0.5 * (u1 - u0) / curve.reach();
  const double per_u = 2 / (u1 - u0);  // dx/du
  Polynomial weight{1.0};
  if (weighted_) weight = shifted(curve.weight(), middle, half);
  Vec value, first, second;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Polynomial p = shifted(curve.coordinate(axis), middle, half);
    if (p.empty()) continue;
    // About the curve's point in the middle, so that the weight's own bending counts only as far as the curve reaches.
    const double centre = p[0] / weight[0];
    if (weighted_) p = p - centre * weight;
    p[0] = 0;
    const auto s = sizes(p);
    value[axis] = s[0];
    first[axis] = s[1];
    second[axis] = s[2];
  }
  if (!weighted_) return norm(second) * per_u * per_u;
  // With h = N/w: h'' = (N'' − 2 h' w' − h w'')/w and h' = (N' − h w')/w.
  const auto w = sizes(weight);
  const double least = 2 * std::abs(weight[0]) - w[0];
  if (!(least > 0)) return HUGE_VAL;
  const double h = norm(value) / least, h1 = (norm(first) + h * w[1]) / least;
  return (norm(second) + 2 * h1 * w[1] + h * w[2]) / least * per_u * per_u;
}

}  // namespace bahnwerk
