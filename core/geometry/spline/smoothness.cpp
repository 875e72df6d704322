#include "core/geometry/spline/smoothness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/spline/basis_row.hpp"

namespace bahnwerk {
namespace {

/// Gauss's points and weights on [0, 1], by Newton's method on the Legendre polynomial.
std::vector<std::array<double, 2>> gauss(std::size_t n) {
  std::vector<std::array<double, 2>> rule(n);
  const auto count = static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (count + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double p = 1, before = 0;
      for (std::size_t j = 1; j <= n; ++j) {
        const auto m = static_cast<double>(j);
        const double next = ((2 * m - 1) * x * p - (m - 1) * before) / m;
        before = p, p = next;
      }
      slope = count * (x * p - before) / (x * x - 1);
      const double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    rule[n - 1 - i] = {(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

struct Integrand {
  double value;
  Vec a, b, c;  ///< ∂value/∂(first, second, third derivative of the curve)
};

/// The integrand of J at derivatives a, b, c, and backwards through the formula.
Integrand integrand(Vec a, Vec b, Vec c, const SmoothnessWeights& weights) {
  const double r0 = weights.rounding;
  const Vec n = cross(a, b), m = cross(a, c);  // m = n′
  const double S = dot(a, a), T = dot(a, b), G = dot(n, n), D = dot(n, m), S3 = S * S * S, S4 = S3 * S;
  const double q = G / S3, q1 = 2 * D / S3 - 6 * G * T / S4;  // κ² and its derivative
  const double r = std::sqrt(q + r0 * r0), k = r - r0, k1 = q1 / (2 * r), A = std::sqrt(k1 * k1 + r0 * r0);
  const double measure = weights.by_length ? std::sqrt(S) : 1.0;

  const double slope = weights.rate * k1 / A;  // ∂/∂k1
  const double by_q1 = slope / (2 * r), by_q = (weights.curvature * measure - slope * k1 / r) / (2 * r);
  double by_S = -3 * G / S4 * by_q + (-6 * D / S4 + 24 * G * T / (S4 * S)) * by_q1;
  if (weights.by_length) by_S += weights.curvature * k / (2 * measure);
  const double by_G = by_q / S3 - 6 * T / S4 * by_q1, by_D = 2 / S3 * by_q1, by_T = -6 * G / S4 * by_q1;
  const Vec by_n = 2 * by_G * n + by_D * m, by_m = by_D * n;
  return {weights.curvature * k * measure + weights.rate * (A - r0),
          2 * by_S * a + by_T * b + cross(b, by_n) + cross(c, by_m), by_T * a + cross(by_n, a), cross(by_m, a)};
}

Vec vec(const HomogeneousPoint& p) { return {p[0], p[1], p[2]}; }

/// gradient_j = Σ by_points · ∂points/∂β_j.
void chain(const LinkBasis& basis, const LinkEnds& ends, const LinkShape& shape, const std::vector<Vec>& by_points,
           std::span<double> gradient) {
  const auto slopes = link_derivatives(basis, ends, shape);
  for (std::size_t j = 0; j < gradient.size(); ++j) {
    gradient[j] = 0;
    for (std::size_t i = 0; i < by_points.size(); ++i) gradient[j] += dot(by_points[i], vec(slopes[j][i]));
  }
}

}  // namespace

SmoothnessRule::SmoothnessRule(const LinkBasis& basis, std::size_t points_per_span) : points_(basis.size()) {
  const auto rule = gauss(points_per_span);
  std::vector<double> borders = basis.knots();
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  for (std::size_t s = 0; s + 1 < borders.size(); ++s)
    for (const auto& [x, w] : rule) {
      const double width = borders[s + 1] - borders[s];
      weights_.push_back(w * width);
      for (std::size_t order = 0; order < 4; ++order) {
        const auto row = basis_row(basis.knots(), basis.degree(), order, borders[s] + x * width);
        rows_.insert(rows_.end(), row.begin(), row.end());
      }
    }
}

double smoothness(const LinkBasis& basis, const SmoothnessRule& rule, const LinkEnds& ends, const LinkShape& shape,
                  const SmoothnessWeights& weights, std::span<double> gradient) {
  const NurbsPath path = link(basis, ends, shape);
  std::vector<Vec> by_points(gradient.empty() ? 0 : basis.size());
  double sum = 0;
  for (std::size_t q = 0; q < rule.size(); ++q) {
    std::array<Vec, 4> h{};
    std::array<double, 4> w{};
    for (std::size_t o = 0; o < 4; ++o) {
      const auto row = rule.row(q, o);
      for (std::size_t i = 0; i < row.size(); ++i) {
        h[o] += row[i] * vec(path.points[i]);
        w[o] += row[i] * path.points[i][spline_dimension];
      }
    }
    const Vec s0 = h[0] / w[0], s1 = (h[1] - w[1] * s0) / w[0], s2 = (h[2] - 2 * w[1] * s1 - w[2] * s0) / w[0],
              s3 = (h[3] - 3 * w[1] * s2 - 3 * w[2] * s1 - w[3] * s0) / w[0];
    const Integrand f = integrand(s1, s2, s3, weights);
    sum += rule.weight(q) * f.value;
    if (gradient.empty()) continue;
    // Backwards through the quotient.
    std::array<Vec, 4> by;
    by[3] = f.c / w[0];
    by[2] = (f.b - 3 * w[1] * by[3]) / w[0];
    by[1] = (f.a - 3 * w[2] * by[3] - 2 * w[1] * by[2]) / w[0];
    by[0] = -((w[3] * by[3] + w[2] * by[2] + w[1] * by[1]) / w[0]);
    for (std::size_t o = 0; o < 4; ++o) {
      const auto row = rule.row(q, o);
      for (std::size_t i = 0; i < row.size(); ++i) by_points[i] += rule.weight(q) * row[i] * by[o];
    }
  }
  if (!gradient.empty()) chain(basis, ends, shape, by_points, gradient);
  return sum;
}

double control_distance(const LinkBasis& basis, const LinkEnds& ends, const LinkShape& shape,
                        std::span<double> gradient) {
  constexpr double rounding = 1e-6;
  const NurbsPath path = link(basis, ends, shape);
  const std::size_t i = basis.continuity(), j = basis.size() - 1 - i;
  const Vec gap = place(projected(path.points[j])) - place(projected(path.points[i]));
  const double distance = std::sqrt(dot(gap, gap) + rounding * rounding);
  if (!gradient.empty()) {
    std::vector<Vec> by_points(basis.size());
    by_points[i] = gap / (-distance * path.points[i][spline_dimension]);
    by_points[j] = gap / (distance * path.points[j][spline_dimension]);
    chain(basis, ends, shape, by_points, gradient);
  }
  return distance - rounding;
}

}  // namespace bahnwerk
