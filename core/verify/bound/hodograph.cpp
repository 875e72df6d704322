#include "core/verify/bound/hodograph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/verify/rounding.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Polynomial sizes(Polynomial p) {
  for (double& c : p) c = std::abs(c);
  return p;
}

}  // namespace

Hodograph::Hodograph(const Rational& curve)
    : pivot_(curve.pivot()),
      inverse_reach_(1 / curve.reach()),
      begin_((curve.begin() - curve.pivot()) / curve.reach()),
      width_((curve.end() - curve.begin()) / curve.reach()) {
  const Polynomial w = curve.weight(), w1 = derivative(w), zero;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Polynomial n = curve.coordinate(axis);
    if (n.empty()) continue;
    Polynomial v = derivative(n), size = sizes(v);
    if (curve.rational()) {
      size = size * sizes(w) + sizes(n) * sizes(w1);
      v = v * w - n * w1;
      v.resize(std::min(v.size(), 2 * curve.degree() - 1));  // the highest powers of both products cancel
    }
    const std::size_t count = std::min(v.size(), terms);
    std::copy_n(v.begin(), count, v_[axis].begin());
    for (std::size_t j = 0; j < count; ++j) size_[j] += size[j];
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

// Evaluates by Horner's scheme with derivatives; higher powers are omitted.
std::array<double, Hodograph::few> Hodograph::expand(const Row& from, std::size_t count, double middle, double half) {
  double t0 = from[count - 1], t1 = 0, t2 = 0, t3 = 0, t4 = 0;
  for (std::size_t k = count - 1; k-- > 0;) {
    t4 = t4 * middle + t3;
    t3 = t3 * middle + t2;
    t2 = t2 * middle + t1;
    t1 = t1 * middle + t0;
    t0 = t0 * middle + from[k];
  }
  const double square = half * half;
  return {t0, t1 * half, t2 * square, t3 * (square * half), t4 * (square * square)};
}

// Lagrange's remainder behind those powers: |V⁽⁵⁾|/5! half⁵ at most.
std::array<double, 3> Hodograph::rest(double t0, double t1) {
  const auto part_of = [&](double t) {
    return static_cast<std::size_t>(std::clamp((t - begin_) / width_ * parts, 0.0, parts - 1.0));
  };
  const double half = 0.5 * std::abs(t1 - t0), power = half * half * half * half * half;
  std::array<double, 3> most{};
  // Neighbours, too: where rounding decides which part a border belongs to.
  const std::size_t from = part_of(std::min(t0, t1) - 1e-9 * width_), to = part_of(std::max(t0, t1) + 1e-9 * width_);
  for (std::size_t p = from; p <= to; ++p) {
    if (!known_[p]) {
      const double reach = 0.5 * width_ / parts;
      for (std::size_t k = 0; k < axes_; ++k) {
        Row local;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled as far as it is read
        expand(v_[k], count_, begin_ + (2 * static_cast<double>(p) + 1) * reach, 1, local);
        double sum = 0, binomial = 1, distance = 1;
        for (std::size_t j = few; j < count_; ++j) {
          sum += binomial * std::abs(local[j]) * distance;
          binomial *= static_cast<double>(j + 1) / static_cast<double>(j + 1 - few);
          distance *= reach * (1 + 1e-6);
        }
        fifth_[p][k] = sum;
      }
      known_[p] = true;
    }
    for (std::size_t k = 0; k < axes_; ++k) most[k] = std::max(most[k], fifth_[p][k] * power);
  }
  return most;
}

Hodograph::Range Hodograph::range(double u0, double u1) {
  Range range;
  if (count_ == 0) return range;
  const double t0 = (u0 - pivot_) * inverse_reach_, t1 = (u1 - pivot_) * inverse_reach_;
  const double middle = 0.5 * (t0 + t1), half = 0.5 * std::abs(t1 - t0), far = std::max(std::abs(t0), std::abs(t1));
  std::array<std::array<double, few>, 3> v;  // NOLINT(cppcoreguidelines-pro-type-member-init): as above
  std::array<double, 3> left{}, direction{};
  if (count_ > few) left = rest(t0, t1);
  double size = 0, square = 0;
  for (std::size_t j = count_; j-- > 0;) size = size * far + size_[j];
  const double rounding_error = 8 * static_cast<double>(count_ + 1) * epsilon * size;
  for (std::size_t k = 0; k < axes_; ++k) {
    v[k] = expand(v_[k], count_, middle, half);
    square += v[k][0] * v[k][0];
  }
  const double centre = std::sqrt(square);
  if (!(centre > 0)) return range;
  const double inverse = 1 / centre;
  for (std::size_t k = 0; k < axes_; ++k) direction[k] = v[k][0] * inverse;
  const double unseen = left[0] + left[1] + left[2] + 2 * rounding_error;
  double along = centre - unseen, across = unseen;
  for (std::size_t j = 1; j < std::min(count_, few); ++j) {
    double part = v[0][j] * direction[0] + v[1][j] * direction[1];
    if (axes_ == 2) {
      along -= std::abs(part);
      across += std::abs(v[0][j] * direction[1] - v[1][j] * direction[0]);
      continue;
    }
    part += v[2][j] * direction[2];
    double rest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = v[k][j] - part * direction[k];
      rest += side * side;
    }
    along -= std::abs(part);
    across += std::sqrt(rest);
  }
  if (!(along > 0)) return range;
  const double spread = across / along;  // ≥ |T − direction|, for the angle between them is at most its arc tangent
  for (std::size_t k = axes_; k < 3; ++k) range.low[k] = range.high[k] = 0;
  for (std::size_t k = 0; k < axes_; ++k) {
    const auto& c = v[k];
    const double even = c[0] + c[2] + c[4], odd = c[1] + c[3], ends = std::abs(odd);
    double low = even - ends, high = even + ends;
    const double slope = 2 * std::abs(c[2]) + 3 * std::abs(c[3]) + 4 * std::abs(c[4]) + 5 * left[k];
    if (std::abs(c[1]) <
        slope) {  // it is not certainly monotone: the quadratic part counts, and the rest of the others
      const double border = c[0] + c[2];
      low = border - std::abs(c[1]), high = border + std::abs(c[1]);
      if (std::abs(c[1]) < 2 * std::abs(c[2])) {
        const double vertex = c[0] - c[1] * c[1] / (4 * c[2]);
        low = std::min(low, vertex), high = std::max(high, vertex);
      }
      const double others = std::abs(c[3]) + std::abs(c[4]);
      low -= others, high += others;
    }
    low -= left[k] + rounding_error, high += left[k] + rounding_error;
    range.low[k] = std::max({-1.0, direction[k] - spread, low >= 0 ? 0.0 : low / along});
    range.high[k] = std::min({1.0, direction[k] + spread, high <= 0 ? 0.0 : high / along});
  }
  return range;
}

// The binormal curvature is b = V × V' w²/|V|³, h'' = b × h', h''' = b' × h' + b × h'' (cf. curve/end_expansion).
Hodograph::DerivativeBounds Hodograph::derivative_bounds(double u0, double u1) const {
  constexpr DerivativeBounds none{infinite, infinite};
  if (count_ == 0) return none;
  const double t0 = (u0 - pivot_) * inverse_reach_, t1 = (u1 - pivot_) * inverse_reach_;
  const double middle = 0.5 * (t0 + t1), half = 0.5 * std::abs(t1 - t0), far = std::max(std::abs(t0), std::abs(t1));
  std::array<Row, 3> rows{};
  Row w{};
  for (std::size_t k = 0; k < axes_; ++k) expand(v_[k], count_, middle, half, rows[k]);
  double size = 0;
  for (std::size_t j = count_; j-- > 0;) size = size * far + size_[j];
  const double rounding_error = 8 * static_cast<double>(count_ + 1) * epsilon * size;
  expand(w_, weights_, middle, half, w);
  const auto v = [&](std::size_t j) { return Vec{rows[0][j], rows[1][j], rows[2][j]}; };
  double most_w = 0, slope_w = 0;
  for (std::size_t j = 0; j < weights_; ++j)
    most_w += std::abs(w[j]), slope_w += static_cast<double>(j) * std::abs(w[j]);
  const double centre = norm(v(0));
  double least = centre - rounding_error, slope = 0;
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
  first += rounding_error * slope, second += rounding_error * slope * static_cast<double>(count_);
  const double w2 = most_w * most_w, cube = least * least * least;
  DerivativeBounds derivative_bounds;
  derivative_bounds.second = first * w2 / (cube * half);
  derivative_bounds.third =
      w2 / (least * half * half) *
          (second * w2 / cube + 2 * first * most_w * slope_w / cube + 3 * first * w2 * slope / (cube * least)) +
      derivative_bounds.second * derivative_bounds.second;
  return derivative_bounds;
}

}  // namespace bahnwerk::verify
