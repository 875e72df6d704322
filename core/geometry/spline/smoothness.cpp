#include "core/geometry/spline/smoothness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace bahnwerk {
namespace {

/// Gauss's points and weights on [0, 1], by Newton's method on the Legendre polynomial. Those of numeric/gauss_legendre
/// differ in the last bit, and the last bit decides between links of a needle path that are nearly as smooth: a stator
/// coil then takes 2.8 % longer.
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

/// Vectors at two nodes.
struct Pair {
  Lanes<2> x{}, y{}, z{};
};
Pair operator+(const Pair& a, const Pair& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Pair operator-(const Pair& a, const Pair& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Pair operator*(Lanes<2> k, const Pair& a) { return {k * a.x, k * a.y, k * a.z}; }
Lanes<2> dot(const Pair& a, const Pair& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Pair cross(const Pair& a, const Pair& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
void add(Pair& sum, Lanes<2> k, const Pair& a) { sum.x += k * a.x, sum.y += k * a.y, sum.z += k * a.z; }

struct Integrand {
  Lanes<2> value;
  Pair a, b, c;  ///< ∂value/∂(first, second, third derivative of the curve)
};

/// The integrand of J at derivatives a, b, c, and backwards through the formula.
Integrand integrand(const Pair& a, const Pair& b, const Pair& c, const SmoothnessWeights& weights) {
  const double r0 = weights.rounding;
  const Pair n = cross(a, b), m = cross(a, c);  // m = n′
  const Lanes<2> S = dot(a, a), T = dot(a, b), G = dot(n, n), D = dot(n, m);
  const Lanes<2> s = 1 / S, s3 = s * s * s, s4 = s3 * s;
  const Lanes<2> q = G * s3, q1 = 2 * D * s3 - 6 * G * T * s4;  // κ² and its derivative
  const Lanes<2> r = root(q + r0 * r0), k = r - r0, half = 0.5 / r, k1 = q1 * half, A = root(k1 * k1 + r0 * r0);
  const Lanes<2> measure = weights.by_length ? root(S) : Lanes<2>{1, 1};

  const Lanes<2> slope = weights.rate * k1 / A;  // ∂/∂k1
  const Lanes<2> by_q1 = slope * half, by_q = (weights.curvature * measure - 2 * slope * k1 * half) * half;
  Lanes<2> by_S = -3 * G * s4 * by_q + (24 * G * T * s - 6 * D) * s4 * by_q1;
  if (weights.by_length) by_S += weights.curvature * k / (2 * measure);
  const Lanes<2> by_G = by_q * s3 - 6 * T * s4 * by_q1, by_D = 2 * s3 * by_q1, by_T = -6 * G * s4 * by_q1;
  const Pair by_n = 2 * by_G * n + by_D * m, by_m = by_D * n;
  return {weights.curvature * k * measure + weights.rate * (A - r0),
          2 * by_S * a + by_T * b + cross(b, by_n) + cross(c, by_m), by_T * a + cross(by_n, a), cross(by_m, a)};
}

/// Σ over the points: derivative of the homogeneous curve, and of its weight.
Pair along(std::span<const Lanes<2>> row, const std::vector<HomogeneousPoint>& points) {
  Pair sum;
  for (std::size_t i = 0; i < row.size(); ++i)
    sum.x += points[i][0] * row[i], sum.y += points[i][1] * row[i], sum.z += points[i][2] * row[i];
  return sum;
}
Lanes<2> weight_along(std::span<const Lanes<2>> row, const std::vector<HomogeneousPoint>& points) {
  Lanes<2> sum{};
  for (std::size_t i = 0; i < row.size(); ++i) sum += points[i][spline_dimension] * row[i];
  return sum;
}

constexpr std::size_t most_points = link_points(spline_orders - 1);

/// J of a link with these control points, and its gradient by them unless `by_points` is null. Without weights the
/// homogeneous curve is the curve itself, and its place does not matter.
template <bool weighted>
double summed(const SmoothnessRule& rule, const std::vector<HomogeneousPoint>& points, const SmoothnessWeights& weights,
              std::array<Pair, most_points>* by_points) {
  Lanes<2> sum{};
  for (std::size_t q = 0; q < rule.pairs(); ++q) {
    Pair s[4];  // the curve's derivatives
    Lanes<2> w[4], inverse{1, 1};
    for (std::size_t o = weighted ? 0 : 1; o < 4; ++o) {
      s[o] = along(rule.row(q, o), points);
      if (weighted) w[o] = weight_along(rule.row(q, o), points);
    }
    if (weighted) {
      inverse = 1 / w[0];
      s[0] = inverse * s[0];
      s[1] = inverse * (s[1] - w[1] * s[0]);
      s[2] = inverse * (s[2] - 2 * w[1] * s[1] - w[2] * s[0]);
      s[3] = inverse * (s[3] - 3 * w[1] * s[2] - 3 * w[2] * s[1] - w[3] * s[0]);
    }
    const Integrand f = integrand(s[1], s[2], s[3], weights);
    sum += rule.weight(q) * f.value;
    if (by_points == nullptr) continue;
    Pair by[4] = {{}, f.a, f.b, f.c};
    if (weighted) {  // backwards through the quotient
      by[3] = inverse * f.c;
      by[2] = inverse * (f.b - 3 * w[1] * by[3]);
      by[1] = inverse * (f.a - 3 * w[2] * by[3] - 2 * w[1] * by[2]);
      by[0] = -inverse * (w[3] * by[3] + w[2] * by[2] + w[1] * by[1]);
    }
    for (std::size_t o = weighted ? 0 : 1; o < 4; ++o) {
      const auto row = rule.row(q, o);
      by[o] = rule.weight(q) * by[o];
      for (std::size_t i = 0; i < row.size(); ++i) add((*by_points)[i], row[i], by[o]);
    }
  }
  return bahnwerk::sum(sum);
}

/// Derivative `order` of all Bernstein polynomials of this degree at u: differences of those of a lower degree.
std::vector<double> bernstein(std::size_t degree, std::size_t order, double u) {
  std::vector<double> b(degree + 1, 0.0);
  b[0] = 1;
  for (std::size_t p = 1; p <= degree; ++p) {
    const bool difference = p + order > degree;
    for (std::size_t i = p + 1; i-- > 0;) {
      const double left = i > 0 ? b[i - 1] : 0, here = i < p ? b[i] : 0;
      b[i] = difference ? static_cast<double>(p) * (left - here) : u * left + (1 - u) * here;
    }
  }
  return b;
}

}  // namespace

SmoothnessRule::SmoothnessRule(std::size_t continuity, std::size_t points) : continuity_(continuity) {
  if (continuity < 1 || continuity >= spline_orders) throw std::invalid_argument("a link needs a continuity of 1 to 4");
  const auto rule = gauss(points);
  const std::size_t degree = link_points(continuity) - 1;
  for (std::size_t i = 0; i < points; i += 2) {
    const auto [x, w] = rule[i];
    const auto [y, v] = i + 1 < points ? rule[i + 1] : std::array<double, 2>{x, 0.0};
    weights_.push_back(Lanes<2>{w, v});
    for (std::size_t order = 0; order < 4; ++order) {
      const auto a = bernstein(degree, order, x), b = bernstein(degree, order, y);
      for (std::size_t j = 0; j <= degree; ++j) rows_.push_back(Lanes<2>{a[j], b[j]});
    }
  }
}

double smoothness(const SmoothnessRule& rule, const LinkEnds& ends, const LinkShape& shape,
                  const SmoothnessWeights& weights, std::span<double> gradient) {
  const BezierPiece piece = link(rule.continuity(), ends, shape);
  std::array<Pair, most_points> by_points{};
  auto* wanted = gradient.empty() ? nullptr : &by_points;
  const double j = shape.weights.empty() ? summed<false>(rule, piece.points(), weights, wanted)
                                         : summed<true>(rule, piece.points(), weights, wanted);
  if (!gradient.empty()) {
    std::array<Vec, most_points> by;
    for (std::size_t i = 0; i < by.size(); ++i) by[i] = {sum(by_points[i].x), sum(by_points[i].y), sum(by_points[i].z)};
    link_gradient(rule.continuity(), ends, shape, std::span(by).first(piece.points().size()), gradient);
  }
  return j;
}

double control_distance(std::size_t continuity, const LinkEnds& ends, const LinkShape& shape,
                        std::span<double> gradient) {
  constexpr double rounding = 1e-6;
  const auto points = link(continuity, ends, shape).points();
  const std::size_t i = continuity, j = points.size() - 1 - i;
  const Vec gap = place(projected(points[j])) - place(projected(points[i]));
  const double distance = std::sqrt(bahnwerk::dot(gap, gap) + rounding * rounding);
  if (!gradient.empty()) {
    std::array<Vec, most_points> by{};
    by[i] = gap / (-distance * points[i][spline_dimension]);
    by[j] = gap / (distance * points[j][spline_dimension]);
    link_gradient(continuity, ends, shape, std::span(by).first(points.size()), gradient);
  }
  return distance - rounding;
}

}  // namespace bahnwerk
