#include "core/verify/bound/hodograph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon(), infinite = std::numeric_limits<double>::infinity();

Polynomial sizes(Polynomial p) {
  for (double& c : p) c = std::abs(c);
  return p;
}

}  // namespace

Hodograph::Hodograph(const Rational& curve) : pivot_(curve.pivot()), inverse_reach_(1 / curve.reach()) {
  const Polynomial w = curve.weight(), w1 = derivative(w), zero;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Polynomial n = curve.coordinate(axis);
    if (n.empty()) continue;
    Polynomial v = derivative(n), size = sizes(v);
    if (curve.rational()) {
      size = size * sizes(w) + sizes(n) * sizes(w1);
      v = v * w - n * w1;
      v.resize(std::min(v.size(), 2 * curve.degree() - 1));  // the highest power of both products is the same
    }
    const std::size_t count = std::min(v.size(), terms);
    std::copy_n(v.begin(), count, v_[axis].begin());
    std::copy_n(size.begin(), count, size_[axis].begin());
    count_ = std::max(count_, count);
    if (axis == 2 && std::any_of(v.begin(), v.end(), [](double c) { return c != 0; })) axes_ = 3;
  }
  weights_ = w.size();
  std::copy(w.begin(), w.end(), w_.begin());
}

void Hodograph::expand(const Row& from, std::size_t count, double middle, double half, Row& to) {
  std::copy_n(from.begin(), count, to.begin());
  for (std::size_t k = 0; k + 1 < count; ++k)
    for (std::size_t i = count - 1; i-- > k;) to[i] += middle * to[i + 1];
  double power = 1;
  for (std::size_t k = 0; k < count; ++k, power *= half) to[k] *= power;
}

Hodograph::Range Hodograph::range(double u0, double u1) const {
  Range range;
  if (count_ == 0) return range;
  const double t0 = (u0 - pivot_) * inverse_reach_, t1 = (u1 - pivot_) * inverse_reach_;
  const double middle = 0.5 * (t0 + t1), half = 0.5 * std::abs(t1 - t0), far = std::max(std::abs(t0), std::abs(t1));
  std::array<Row, 3> v;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled as far as it is read
  std::array<double, 3> blur{}, direction{};
  double square = 0, blurred = 0;
  for (std::size_t k = 0; k < axes_; ++k) {
    expand(v_[k], count_, middle, half, v[k]);
    double size = 0;
    for (std::size_t j = count_; j-- > 0;) size = size * far + size_[k][j];
    blur[k] = 8 * static_cast<double>(count_ + 1) * epsilon * size;
    square += v[k][0] * v[k][0];
    blurred += blur[k];
  }
  const double centre = std::sqrt(square);
  if (!(centre > 0)) return range;
  for (std::size_t k = 0; k < axes_; ++k) direction[k] = v[k][0] / centre;
  double along = centre - blurred, across = blurred;
  for (std::size_t j = 1; j < count_; ++j) {
    double part = 0, rest = 0;
    for (std::size_t k = 0; k < axes_; ++k) part += v[k][j] * direction[k];
    for (std::size_t k = 0; k < axes_; ++k) {
      const double side = v[k][j] - part * direction[k];
      rest += side * side;
    }
    along -= std::abs(part) + 8 * epsilon * centre;
    across += std::sqrt(rest) + 8 * epsilon * centre;
  }
  if (!(along > 0)) return range;
  const double spread = across / along;  // ≥ |T − direction|, for the angle between them is at most its arc tangent
  for (std::size_t k = 0; k < 3; ++k) {
    if (k >= axes_) {
      range.low[k] = range.high[k] = 0;
      continue;
    }
    double slope = 0, rest = 0, minus = 0, plus = 0, sign = 1;
    for (std::size_t j = 0; j < count_; ++j, sign = -sign) {
      const double c = v[k][j];
      plus += c, minus += sign * c;
      if (j >= 2) slope += static_cast<double>(j) * std::abs(c);
      if (j >= 3) rest += std::abs(c);
    }
    double low = std::min(minus, plus), high = std::max(minus, plus);
    if (count_ > 2 && std::abs(v[k][1]) < slope) {  // not monotone for certain
      const double c0 = v[k][0], c1 = v[k][1], c2 = v[k][2];
      low = std::min(c0 - c1 + c2, c0 + c1 + c2), high = std::max(c0 - c1 + c2, c0 + c1 + c2);
      if (std::abs(c1) < 2 * std::abs(c2)) {
        const double vertex = c0 - c1 * c1 / (4 * c2);
        low = std::min(low, vertex), high = std::max(high, vertex);
      }
      low -= rest, high += rest;
    }
    low -= blur[k], high += blur[k];
    range.low[k] = std::max({-1.0, direction[k] - spread, low >= 0 ? 0.0 : low / along});
    range.high[k] = std::min({1.0, direction[k] + spread, high <= 0 ? 0.0 : high / along});
  }
  return range;
}

// The binormal curvature is b = V × V' w²/|V|³, h'' = b × h', h''' = b' × h' + b × h'' (cf. curve/end_expansion).
Hodograph::Bends Hodograph::bends(double u0, double u1) const {
  constexpr Bends none{infinite, infinite};
  if (count_ == 0) return none;
  const double t0 = (u0 - pivot_) * inverse_reach_, t1 = (u1 - pivot_) * inverse_reach_;
  const double middle = 0.5 * (t0 + t1), half = 0.5 * std::abs(t1 - t0), far = std::max(std::abs(t0), std::abs(t1));
  std::array<Row, 3> rows{};
  Row w{};
  double blur = 0;
  for (std::size_t k = 0; k < axes_; ++k) {
    expand(v_[k], count_, middle, half, rows[k]);
    double size = 0;
    for (std::size_t j = count_; j-- > 0;) size = size * far + size_[k][j];
    blur += 8 * static_cast<double>(count_ + 1) * epsilon * size;
  }
  expand(w_, weights_, middle, half, w);
  const auto v = [&](std::size_t j) { return Vec{rows[0][j], rows[1][j], rows[2][j]}; };
  double most_w = 0, slope_w = 0;
  for (std::size_t j = 0; j < weights_; ++j)
    most_w += std::abs(w[j]), slope_w += static_cast<double>(j) * std::abs(w[j]);
  const double centre = norm(v(0));
  double least = centre - blur, slope = 0;
  for (std::size_t j = 1; j < count_; ++j) {
    least -= centre > 0 ? std::abs(dot(v(j), v(0))) / centre : 0;
    slope += static_cast<double>(j) * norm(v(j));
  }
  if (!(least > 0)) return none;
  double first = 0, second = 0;  // |V × V'|, |V × V''|
  for (std::size_t i = 0; i < count_; ++i)
    for (std::size_t j = i + 1; j < count_; ++j) {
      const double turn = norm(cross(v(i), v(j))), n = static_cast<double>(i), m = static_cast<double>(j);
      first += (m - n) * turn;
      second += (m * (m - 1) - n * (n - 1)) * turn;
    }
  first += blur * slope, second += blur * slope * static_cast<double>(count_);
  const double w2 = most_w * most_w, cube = least * least * least;
  Bends bends;
  bends.second = first * w2 / (cube * half);
  bends.third =
      w2 / (least * half * half) *
          (second * w2 / cube + 2 * first * most_w * slope_w / cube + 3 * first * w2 * slope / (cube * least)) +
      bends.second * bends.second;
  return bends;
}

}  // namespace bahnwerk::verify
