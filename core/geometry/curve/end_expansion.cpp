#include "core/geometry/curve/end_expansion.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

using Vectors = std::array<Polynomial, 3>;

Polynomial dot(const Vectors& a, const Vectors& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vectors cross(const Vectors& a, const Vectors& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class F>
Vectors each(F&& f) {
  return {f(0), f(1), f(2)};
}
Vectors derivative(const Vectors& a) {
  return each([&](std::size_t i) { return bahnwerk::derivative(a[i]); });
}
Vectors deflated(const Vectors& a, std::size_t k) {
  return each([&](std::size_t i) { return bahnwerk::deflated(a[i], k); });
}
std::size_t size(const Vectors& a) { return std::max({a[0].size(), a[1].size(), a[2].size()}); }
Vec coefficient(const Vectors& a, std::size_t k) {
  const auto at = [&](std::size_t i) { return k < a[i].size() ? a[i][k] : 0.0; };
  return {at(0), at(1), at(2)};
}
double largest(const Vectors& a) {
  double most = 0;
  for (std::size_t k = 0; k < size(a); ++k) most = std::max(most, norm(coefficient(a, k)));
  return most;
}
/// Leading (lowest) coefficients that are rounding only.
std::size_t negligible(const Vectors& a, double tolerance) {
  std::size_t k = 0;
  while (k < size(a) && norm(coefficient(a, k)) <= tolerance) ++k;
  return k;
}

constexpr double near_zone = 1.0 / 16;
/// Returns the coefficients that matter for ρ ≤ 1/16.
std::vector<Vec> trimmed(const Vectors& a) {
  double most = 0, power = 1;
  for (std::size_t k = 0; k < size(a); ++k, power *= near_zone) most = std::max(most, norm(coefficient(a, k)) * power);
  std::vector<Vec> rows;
  power = 1;
  for (std::size_t k = 0; k < size(a); ++k, power *= near_zone) {
    if (norm(coefficient(a, k)) * power < 1e-20 * most) continue;
    rows.resize(k + 1);
    rows[k] = coefficient(a, k);
  }
  if (rows.empty()) rows.resize(1);
  return rows;
}
Vec value(const std::vector<Vec>& rows, double rho) {
  Vec sum;
  for (std::size_t k = rows.size(); k-- > 0;) sum = rho * sum + rows[k];
  return sum;
}
double power(double rho, int exponent) {
  double result = 1;
  const double factor = exponent < 0 ? 1 / rho : rho;
  for (int k = std::abs(exponent); k > 0; --k) result *= factor;
  return result;
}

}  // namespace

EndExpansion::EndExpansion(const Rational& curve) {
  const bool at_end = curve.vanishing_end() > 0;
  const std::size_t order = std::max(curve.vanishing_begin(), curve.vanishing_end());
  const int m = static_cast<int>(order);
  end_ = at_end ? curve.end() : curve.begin();
  inward_ = at_end ? -1 : 1;
  inverse_reach_ = 1 / curve.reach();
  zone_ = near_zone * curve.reach();
  // The variable is ρ = |u − end|/reach: at the far end the curve is read backwards.
  const Polynomial w = shifted(curve.weight(), 0, inward_), w1 = bahnwerk::derivative(w);
  const Vectors n = each([&](std::size_t i) { return shifted(curve.coordinate(i), 0, inward_); });
  const Vectors v = each([&](std::size_t i) {
    return curve.rational() ? bahnwerk::derivative(n[i]) * w - n[i] * w1 : bahnwerk::derivative(n[i]);
  });
  const Vectors W = deflated(v, order), W1 = derivative(W);
  Vectors D = cross(W, W1);
  const double size_w = largest(W), tolerance = 1e-10 * size_w * size_w;
  const std::size_t r = negligible(D, tolerance);
  const Vectors C = deflated(D, r);
  const int p = static_cast<int>(r) - m;
  curvature_power_ = size(C) == 0 ? 0 : p;
  // db/ds = ρ^(p−1−m) w³ G/|W|⁶ with G = p w C |W|² + ρ (|W|² (2 w' C + w C') − 3 w C (W·W')).
  const Polynomial square = dot(W, W), product = dot(W, W1), rho{0.0, 1.0};
  const Vectors C1 = derivative(C);
  const Vectors G = each([&](std::size_t i) {
    return static_cast<double>(p) * (w * C[i] * square) +
           rho * (square * (2.0 * (w1 * C[i]) + w * C1[i]) - 3.0 * (w * C[i] * product));
  });
  const std::size_t g = negligible(G, 1e-10 * largest(C) * size_w * size_w);
  rate_power_ = p - 1 - m + static_cast<int>(g);
  if (size(G) <= g) rate_power_ = 0;
  tangent_ = trimmed(W);
  binormal_ = trimmed(C);
  rate_ = trimmed(deflated(G, g));
  weight_ = w;
}

void EndExpansion::derivatives(double u, Jet& point) const {
  const double rho = (u - end_) * inward_ * inverse_reach_;
  const Vec W = value(tangent_, rho);
  const double length = norm(W), w = evaluate(weight_, rho), w2 = w * w;
  const double l3 = length * length * length;
  const Vec tangent = W / length;
  Vec b, rate;
  if (rho > 0 || curvature_power_ >= 0) b = (w2 * power(rho, curvature_power_) / l3) * value(binormal_, rho);
  if (rho > 0 || (curvature_power_ >= 0 && rate_power_ >= 0)) {
    rate = (w2 * w * power(rho, rate_power_) / (l3 * l3)) * value(rate_, rho);
  }
  const Vec d2 = cross(b, tangent), d3 = cross(rate, tangent) + cross(b, d2);
  point.d1 = inward_ * tangent;  // reading backwards turns the odd derivatives
  point.d2 = d2;
  point.d3 = inward_ * d3;
}

}  // namespace bahnwerk
