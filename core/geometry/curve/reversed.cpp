#include "core/geometry/curve/reversed.hpp"

#include <cmath>
#include <vector>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {
namespace {

/// Bernstein coefficients over t ∈ [begin, end] of a polynomial, raised to the degree n: with p(begin + (end − begin)
/// x) = Σ q_k x^k they are b_i = Σ q_k C(i, k)/C(n, k) over k ≤ i.
std::vector<double> bernstein(const Polynomial& p, double begin, double end, std::size_t n) {
  const Polynomial q = shifted(p, begin, end - begin);
  std::vector<double> b(n + 1, 0.0);
  for (std::size_t i = 0; i <= n; ++i) {
    double share = 1;  // C(i, k)/C(n, k)
    for (std::size_t k = 0; k <= i && k < q.size(); ++k) {
      b[i] += share * q[k];
      share *= static_cast<double>(i - k) / static_cast<double>(n - k);
    }
  }
  return b;
}

/// Reverses the control points.
Rational backwards(const Rational& curve) {
  const double begin = (curve.begin() - curve.pivot()) / curve.reach(),
               end = (curve.end() - curve.pivot()) / curve.reach();
  const std::size_t n = curve.degree();
  const std::vector<double> weights = bernstein(curve.weight(), begin, end, n);
  std::vector<Vec> points(n + 1, curve.origin());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> row = bernstein(curve.coordinate(axis), begin, end, n);
    for (std::size_t i = 0; i <= n; ++i) points[n - i][axis] += row[i] / weights[i];
  }
  Rational turned = Rational::bezier(
      points, curve.rational() ? std::vector<double>(weights.rbegin(), weights.rend()) : std::vector<double>{});
  // A tangent that vanishes at an end does so at the other one now.
  if (const std::size_t order = curve.vanishing_begin(); order > 0)
    return turned.restricted(turned.begin(), turned.end(), turned.end(), order);
  if (const std::size_t order = curve.vanishing_end(); order > 0)
    return turned.restricted(turned.begin(), turned.end(), turned.begin(), order);
  return turned;
}

}  // namespace

std::shared_ptr<const Curve> reversed(const Curve& curve) {
  if (curve.kind() == CurveKind::line) {
    const auto& line = static_cast<const Line&>(curve);
    return std::make_shared<Line>(line.to(), line.from());
  }
  if (curve.kind() == CurveKind::arc) {
    // With E₁, E₂ the frame at the end, φ = sweep − u·sweep gives cos(u·sweep) E₁ − sin(u·sweep) E₂: the normal is
    // reversed, sweep and rise keep their signs.
    const auto& arc = static_cast<const Arc&>(curve);
    const double c = std::cos(arc.sweep()), s = std::sin(arc.sweep());
    return std::make_shared<Arc>(arc.centre() + arc.rise() * arc.normal(), c * arc.e1() + s * arc.e2(),
                                 s * arc.e1() - c * arc.e2(), arc.radius(), arc.sweep(), arc.rise());
  }
  return std::make_shared<Rational>(backwards(static_cast<const Rational&>(curve)));
}

}  // namespace bahnwerk
