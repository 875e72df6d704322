#include "core/geometry/path/regular.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

using VectorPolynomial = std::array<Polynomial, 3>;

Vec coefficient(const VectorPolynomial& v, std::size_t k) {
  return {k < v[0].size() ? v[0][k] : 0.0, k < v[1].size() ? v[1][k] : 0.0, k < v[2].size() ? v[2][k] : 0.0};
}
std::size_t length_of(const VectorPolynomial& v) { return std::max({v[0].size(), v[1].size(), v[2].size()}); }
Vec evaluate(const VectorPolynomial& v, double t) {
  return {bahnwerk::evaluate(v[0], t), bahnwerk::evaluate(v[1], t), bahnwerk::evaluate(v[2], t)};
}
VectorPolynomial shifted(const VectorPolynomial& v, double at, double scale) {
  return {bahnwerk::shifted(v[0], at, scale), bahnwerk::shifted(v[1], at, scale), bahnwerk::shifted(v[2], at, scale)};
}
VectorPolynomial derivative(const VectorPolynomial& v) {
  return {bahnwerk::derivative(v[0]), bahnwerk::derivative(v[1]), bahnwerk::derivative(v[2])};
}

/// Returns w² dh/dt as a polynomial: N' w − N w'.
VectorPolynomial hodograph(const Rational& curve) {
  const Polynomial w = curve.weight(), w1 = bahnwerk::derivative(w);
  VectorPolynomial v;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Polynomial n = curve.coordinate(axis);
    v[axis] = curve.rational() ? bahnwerk::derivative(n) * w - n * w1 : bahnwerk::derivative(n);
  }
  return v;
}

struct Interval {
  double low, high;
};

/// Relative value below which |v| may fall where the curve turns round in a needle point, and the width of an interval
/// of t that then counts as one place.
constexpr double needle_speed = 3e-4, needle_width = 1e-4;

/// Returns whether |v| only rises or only falls for |t| ≤ 1: v·v′ keeps its sign.
bool monotonous(const VectorPolynomial& v) {
  double middle = 0, rest = 0;
  const std::size_t n = length_of(v);
  for (std::size_t k = 0; k + 1 < 2 * n; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j <= k && j + 1 < n; ++j)
      if (k - j < n) sum += static_cast<double>(j + 1) * dot(coefficient(v, k - j), coefficient(v, j + 1));
    (k == 0 ? middle : rest) += std::abs(sum);
  }
  return middle > 1.001 * rest;
}

/// Collects, in order, small intervals of t on which |v| cannot be shown to be positive, or has a minimum below `slow`,
/// or is all but zero throughout (there rounding decides its direction).
void suspects(const VectorPolynomial& v, Interval range, double negligible, double slow, int depth,
              std::vector<Interval>& found) {
  const double middle = 0.5 * (range.low + range.high);
  const VectorPolynomial local = shifted(v, middle, 0.5 * (range.high - range.low));
  const Vec v0 = coefficient(local, 0);
  const double size = norm(v0);
  double rest = 0, along = 0;
  for (std::size_t k = 1; k < length_of(local); ++k) {
    rest += norm(coefficient(local, k));
    along += std::abs(dot(v0, coefficient(local, k)));
  }
  const bool tiny = size + rest <= negligible;
  // v has a positive component along v(middle) on the whole interval (with a margin for a zero at its border).
  const bool positive = !tiny && along < 0.999 * size * size;
  if (positive && (size * size - along >= slow * size || monotonous(local))) return;
  if (tiny || depth == 0 || found.size() > 4096 || (positive && range.high - range.low <= needle_width)) {
    found.push_back(range);
    return;
  }
  suspects(v, {range.low, middle}, negligible, slow, depth - 1, found);
  suspects(v, {middle, range.high}, negligible, slow, depth - 1, found);
}

/// The minimum of |v| near t by Gauss–Newton; quadratic where v has a simple zero.
double polish(const VectorPolynomial& v, double t) {
  const VectorPolynomial d = derivative(v);
  for (int i = 0; i < 60; ++i) {
    const Vec value = evaluate(v, t), slope = evaluate(d, t);
    const double square = dot(slope, slope);
    if (square == 0) break;
    const double step = dot(value, slope) / square;
    t -= std::clamp(step, -1e-3, 1e-3);
    if (std::abs(step) < 1e-17) break;
  }
  return t;
}

struct Zero {
  double u;
  std::size_t order;    ///< 0: cut here, but nothing is snapped to zero
  bool needle = false;  ///< the curve turns round here: its pieces are expanded about this point
  bool pivot() const { return order > 0 || needle; }
};

/// Curvature in 1/mm by h' = V/w², V the hodograph: w² |V × V'|/|V|³, whatever the parameter.
double curvature_at(const Rational& curve, const VectorPolynomial& v, double t) {
  const Vec value = evaluate(v, t), slope = evaluate(derivative(v), t);
  const double w = bahnwerk::evaluate(curve.weight(), t), size = norm(value);
  return w * w * norm(cross(value, slope)) / (size * size * size);
}

/// The sum of 16 chords: never above the length, whatever the weights.
double rough_length(const Rational& curve) {
  constexpr int chords = 16;
  double sum = 0;
  Vec before = curve.at(curve.begin()).value;
  for (int i = 1; i <= chords; ++i) {
    const Vec here = curve.at(curve.begin() + (curve.end() - curve.begin()) * i / chords).value;
    sum += norm(here - before);
    before = here;
  }
  return sum;
}

/// Returns how many of the coefficients 1, 2, … of h − h(pivot) are negligible.
std::size_t order_at(const Rational& expanded, double tolerance) {
  const Polynomial x = expanded.coordinate(0), y = expanded.coordinate(1), z = expanded.coordinate(2);
  std::size_t order = 0;
  while (order + 1 < x.size() && norm(Vec{x[order + 1], y[order + 1], z.empty() ? 0.0 : z[order + 1]}) <= tolerance) {
    ++order;
  }
  return order + 1 < x.size() ? order : 0;  // if all are negligible, the curve is a point
}

std::vector<Zero> inner_zeros(const Rational& curve, const VectorPolynomial& v, double tolerance) {
  double scale = 0;
  for (std::size_t k = 0; k < length_of(v); ++k) scale += norm(coefficient(v, k));
  const double from = (curve.begin() - curve.pivot()) / curve.reach(),
               to = (curve.end() - curve.pivot()) / curve.reach();
  std::vector<Interval> found;
  suspects(v, {from, to}, 1e-10 * scale, needle_speed * scale, 24, found);
  std::vector<Zero> zeros;
  const auto parameter = [&](double t) { return curve.pivot() + curve.reach() * t; };
  for (std::size_t i = 0; i < found.size();) {
    // Neighbouring intervals are one suspect; a zero of high order is blurred more widely than a simple one.
    std::size_t j = i + 1;
    while (j < found.size() && found[j].low - found[j - 1].high < 1e-4) ++j;
    const double low_end = found[i].low, high_end = found[j - 1].high;
    const double start = 0.5 * (low_end + high_end), near = 1e-4 + (high_end - low_end);
    i = j;
    double best = start;
    std::size_t order = 0;
    bool low = norm(evaluate(v, start)) <= 1e-7 * scale, needle = false;
    VectorPolynomial d = v;
    for (std::size_t m = 1; m <= curve.degree();
         ++m, d = derivative(d)) {  // v^(m−1) has a simple zero where v has an m-fold one
      const double t = std::clamp(polish(d, start), from, to);
      if (std::abs(t - start) > near) continue;
      if (m == 1) {
        const double speed = norm(evaluate(v, t));
        needle = speed > 0 && curvature_at(curve, v, t) * rough_length(curve) > sharpest_curvature;
        if (needle || speed <= 1e-7 * scale) {
          best = t;
          low = true;
        }
      }
      const double u = parameter(t);
      if (order_at(curve.restricted(curve.begin(), curve.end(), u), tolerance) >= m) {
        best = t;
        order = m;
      }
    }
    if (!low && order == 0) continue;
    const double margin = 1e-9 * (to - from);
    if (best - from > margin && to - best > margin) zeros.push_back({parameter(best), order, needle});
  }
  return zeros;
}

}  // namespace

std::vector<Rational> regular_pieces(const Rational& given) {
  if (given.extent() == 0) return {given};
  const Rational curve = given.collinear() ? given.straightened() : given;
  const double tolerance = std::max(1e-12 * curve.extent(), curve.noise());
  const VectorPolynomial v = hodograph(curve);
  std::vector<Zero> cuts = inner_zeros(curve, v, tolerance);
  const double u0 = curve.begin(), u1 = curve.end();
  const auto end_order = [&](double u) {
    if (curve.speed(u) * (u1 - u0) > 2 * tolerance) return std::size_t{0};  // the first coefficient, but for rounding
    return order_at(curve.restricted(u0, u1, u), tolerance);
  };
  cuts.insert(cuts.begin(), {u0, end_order(u0), false});
  cuts.push_back({u1, end_order(u1), false});
  if (cuts.size() == 2 && cuts[0].order == 0 && cuts[1].order == 0) return {given};
  std::vector<Rational> pieces;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const Zero &before = cuts[i], &after = cuts[i + 1];
    const double a = before.u, b = after.u, middle = 0.5 * (a + b);
    if (before.pivot() && after.pivot()) {
      pieces.push_back(curve.restricted(a, middle, a, before.order));
      pieces.push_back(curve.restricted(middle, b, b, after.order));
    } else if (before.pivot()) {
      pieces.push_back(curve.restricted(a, b, a, before.order));
    } else if (after.pivot()) {
      pieces.push_back(curve.restricted(a, b, b, after.order));
    } else {
      pieces.push_back(curve.restricted(a, b, middle));
    }
  }
  return pieces;
}

}  // namespace bahnwerk
