#include "core/geometry/path/arc_length.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/chebyshev.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t nodes = 12;  // degree 11 for the speed

/// Lobatto points and the matrices samples → Chebyshev coefficients and Chebyshev → power coefficients of the integral.
struct Tables {
  std::array<double, nodes> x;
  std::array<std::array<double, nodes>, nodes> transform;
  std::array<std::array<double, nodes>, nodes + 1>
      integral;                                  ///< integral of Σ c_k T_k with value 0 at x = −1, power basis
  std::array<double, 8> y;                       ///< Lobatto points for the inverse
  std::array<std::array<double, 8>, 8> inverse;  ///< samples there → power basis

  Tables() {
    const auto points = Chebyshev::lobatto(nodes - 1);
    std::copy(points.begin(), points.end(), x.begin());
    for (std::size_t j = 0; j < nodes; ++j) {
      std::vector<double> unit(nodes, 0.0);
      unit[j] = 1;
      const auto c = Chebyshev::from_samples(unit);
      for (std::size_t k = 0; k < nodes; ++k) transform[k][j] = c[k];
      const auto p = Chebyshev(-1, 1, unit).integral().power_basis();
      for (std::size_t k = 0; k <= nodes; ++k) integral[k][j] = k < p.size() ? p[k] : 0.0;
    }
    const auto few = Chebyshev::lobatto(7);
    std::copy(few.begin(), few.end(), y.begin());
    for (std::size_t j = 0; j < 8; ++j) {
      std::vector<double> unit(8, 0.0);
      unit[j] = 1;
      const auto p = Chebyshev(-1, 1, Chebyshev::from_samples(unit)).power_basis();
      for (std::size_t k = 0; k < 8; ++k) inverse[k][j] = p[k];
    }
  }
};
const Tables& tables() {
  static const Tables made;
  return made;
}

/// Length of a step of Newton's method in x that, with the correction by the second derivative of s(x), leaves an error
/// of third order below rounding.
constexpr double short_step = 4e-6;

/// Σ c[k] x^k, k < 13, by Estrin's scheme: short dependency chains, fixed order of operations.
template <class Number>
Number estrin(const std::array<double, 13>& c, Number x) {
  const Number x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  const Number a = (c[0] + c[1] * x) + (c[2] + c[3] * x) * x2, b = (c[4] + c[5] * x) + (c[6] + c[7] * x) * x2;
  const Number d = (c[8] + c[9] * x) + (c[10] + c[11] * x) * x2;
  return (a + b * x4) + (d + c[12] * x4) * x8;
}
/// Σ k c[k] x^(k−1).
template <class Number>
Number estrin_slope(const std::array<double, 13>& c, Number x) {
  const Number x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  const Number a = (c[1] + 2 * c[2] * x) + (3 * c[3] + 4 * c[4] * x) * x2;
  const Number b = (5 * c[5] + 6 * c[6] * x) + (7 * c[7] + 8 * c[8] * x) * x2;
  const Number d = (9 * c[9] + 10 * c[10] * x) + (11 * c[11] + 12 * c[12] * x) * x2;
  return a + b * x4 + d * x8;
}
/// Σ ½ k (k − 1) c[k] x^(k−2).
template <class Number>
Number estrin_second_derivative(const std::array<double, 13>& c, Number x) {
  const Number x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  const Number a = (c[2] + 3 * c[3] * x) + (6 * c[4] + 10 * c[5] * x) * x2;
  const Number b = (15 * c[6] + 21 * c[7] * x) + (28 * c[8] + 36 * c[9] * x) * x2;
  const Number d = (45 * c[10] + 55 * c[11] * x) + 66 * c[12] * x2;
  return a + b * x4 + d * x8;
}
template <class Number>
Number estrin(const std::array<double, 8>& c, Number x) {
  const Number x2 = x * x, x4 = x2 * x2;
  return ((c[0] + c[1] * x) + (c[2] + c[3] * x) * x2) + ((c[4] + c[5] * x) + (c[6] + c[7] * x) * x2) * x4;
}

/// Index of the panel that holds x among ascending borders, without branches in the loop.
std::size_t panel_of(const std::vector<double>& borders, double x) {
  const double* base = borders.data();
  std::size_t count = borders.size() - 1;
  while (count > 1) {
    const std::size_t half = count / 2;
    base += base[half] <= x ? half : 0;
    count -= half;
  }
  return static_cast<std::size_t>(base - borders.data());
}

}  // namespace

ArcLength::ArcLength(const Curve& curve) : begin_(curve.begin()), end_(curve.end()) {
  if (curve.kind() != CurveKind::rational) {
    length_ = curve.speed(begin_) * (end_ - begin_);
    return;
  }
  const Rational& piece = static_cast<const Rational&>(curve);
  const double width = end_ - begin_;
  double scale = 0;  // chords: never above the length, whatever the parametrisation
  Vec before = piece.at(begin_).value;
  for (int i = 1; i <= 16; ++i) {
    const Vec here = piece.at(i == 16 ? end_ : begin_ + width * i / 16).value;
    scale += norm(here - before);
    before = here;
  }
  if (!(scale > 0 && scale < HUGE_VAL)) return;
  u_.push_back(begin_);
  s_.push_back(0);
  constexpr int levels =
      10;  // levels by a factor of 8, down to 1e-9 of the piece, where s is a monomial to 1e-9 of itself
  if (const std::size_t order = piece.vanishing_begin(); order > 0) {
    double a = begin_;
    for (int k = levels; k >= 0; --k) {
      const double b = begin_ + std::ldexp(width, -3 * k);
      if (!(b > a)) continue;
      k == levels ? add_monomial(piece, a, b, begin_, order) : add(piece, a, b, 0, scale);
      a = b;
    }
  } else if (const std::size_t last = piece.vanishing_end(); last > 0) {
    double a = begin_;
    for (int k = 1; k <= levels + 1; ++k) {
      const double b = k > levels ? end_ : end_ - std::ldexp(width, -3 * k);
      if (!(b > a)) continue;
      k > levels ? add_monomial(piece, a, b, end_, last) : add(piece, a, b, 0, scale);
      a = b;
    }
  } else {
    add(piece, begin_, end_, 0, scale);
  }
  length_ = s_.back();
}

void ArcLength::add(const Rational& curve, double a, double b, int depth, double scale) {
  const Tables& table = tables();
  const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
  std::array<double, nodes> samples, c;
  for (std::size_t j = 0; j < nodes; ++j) samples[j] = curve.speed(centre + half * table.x[j]);
  for (std::size_t k = 0; k < nodes; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) sum += table.transform[k][j] * samples[j];
    c[k] = sum;
  }
  // Two neighbours, so that an even or odd function does not pass by its vanishing every second coefficient. What is
  // cut off continues their decay and is divided by 2·12 in the integral: a few 1e-15 of the panel.
  const double tail = std::abs(c[nodes - 1]) + std::abs(c[nodes - 2]);
  const bool converged = tail <= 2e-13 * c[0] || tail * half <= 1e-14 * scale;
  if (!converged && depth < 48 && centre > a && centre < b && panels_.size() < 100000) {
    add(curve, a, centre, depth + 1, scale);
    add(curve, centre, b, depth + 1, scale);
    return;
  }
  Panel panel{};
  panel.centre = centre;
  panel.inverse_half = 1 / half;
  panel.base = s_.back();
  for (std::size_t k = 0; k <= nodes; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) sum += table.integral[k][j] * c[j];
    panel.s[k] = half * sum;
  }
  finish(panel, a, b);
}

void ArcLength::add_monomial(const Rational& curve, double a, double b, double end, std::size_t order) {
  // The speed is g ρ^m with g constant to 1e-9; ∫ = g ρ^(m+1)/(m+1).
  Panel panel{};
  const double reach = b - a;
  const std::size_t exponent = std::min(order + 1, terms - 1);
  const double total = curve.speed(end == a ? b : a) * reach / static_cast<double>(order + 1);
  panel.centre = end;
  panel.inverse_half = 1 / reach;
  panel.monomial = static_cast<unsigned>(exponent);
  const bool at_end = end != a;
  panel.base = s_.back() + (at_end ? total : 0);
  panel.s[exponent] = at_end ? (exponent % 2 == 0 ? -total : total) : total;  // x ∈ [−1, 0] at the far end
  finish(panel, a, b);
}

void ArcLength::finish(Panel panel, double a, double b) {
  const Tables& table = tables();
  const double xa = (a - panel.centre) * panel.inverse_half, xb = (b - panel.centre) * panel.inverse_half;
  const double sa = s_.back(), sb = std::max(sa, panel.base + estrin(panel.s, xb));
  panel.s_middle = 0.5 * (sa + sb);
  panel.s_inverse_half = sb > sa ? 2 / (sb - sa) : 0;
  if (panel.monomial == 0 && sb > sa) {
    // Inverse at Lobatto points by safeguarded Newton, then a polynomial through them: good to 1e-4 … 1e-9.
    std::array<double, 8> x;
    double guess = xb;
    for (std::size_t j = 0; j < 8; ++j) {
      const double target = panel.s_middle + 0.5 * (sb - sa) * table.y[j] - panel.base;
      double low = xa, high = xb;
      for (int i = 0; i < 60 && high - low > 1e-9; ++i) {
        const double value = estrin(panel.s, guess) - target, slope = estrin_slope(panel.s, guess);
        (value > 0 ? high : low) = guess;
        double next = guess - value / slope;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        const bool done = std::abs(next - guess) < 1e-5;  // the next error is of the order of its square
        guess = next;
        if (done) break;
      }
      x[j] = guess;
    }
    for (std::size_t k = 0; k < 8; ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < 8; ++j) sum += table.inverse[k][j] * x[j];
      panel.start[k] = sum;
    }
  }
  panels_.push_back(panel);
  u_.push_back(b);
  s_.push_back(sb);
}

double ArcLength::at(double u) const {
  if (panels_.empty()) return length_ * std::clamp((u - begin_) / (end_ - begin_), 0.0, 1.0);
  if (!(u > begin_)) return 0;
  if (!(u < end_)) return length_;
  const Panel& panel = panels_[panel_of(u_, u)];
  return std::clamp(panel.base + estrin(panel.s, (u - panel.centre) * panel.inverse_half), 0.0, length_);
}

void ArcLength::at(PathBatch& batch) const {
  if (!panels_.empty()) {
    const std::size_t i = panel_of(u_, std::clamp(batch.u[0], begin_, end_));
    if (batch.u[0] > begin_ && batch.u[batch.count - 1] <= u_[i + 1]) {
      const Panel& panel = panels_[i];
      for (std::size_t p = 0; p < batch.used_pairs(); ++p)
        batch.s.pair[p] = panel.base + estrin(panel.s, (batch.u.pair[p] - panel.centre) * panel.inverse_half);
      return;
    }
  }
  for (std::size_t i = 0; i < batch.count; ++i) batch.s.set(i, at(batch.u[i]));
}

std::vector<double> ArcLength::borders() const { return panels_.empty() ? std::vector{begin_, end_} : u_; }

double ArcLength::inverse(double s) const {
  if (!(s > 0)) return begin_;
  if (!(s < length_)) return end_;
  if (panels_.empty()) return begin_ + (end_ - begin_) * (s / length_);
  const std::size_t i = panel_of(s_, s);
  return std::clamp(inverse_on(panels_[i], s), u_[i], u_[i + 1]);
}

PointPair ArcLength::inverse(PointPair s) const {
  if (!panels_.empty() && s[0] > 0 && s[1] >= s[0] && s[1] < length_) {
    const std::size_t i = panel_of(s_, s[0]);
    const Panel& panel = panels_[i];
    if (panel.monomial == 0 && s[1] <= s_[i + 1]) {
      const PointPair y = (s - panel.s_middle) * panel.s_inverse_half;
      const PointPair x = larger(smaller(estrin(panel.start, y), PointPair{1, 1}), PointPair{-1, -1});
      const PointPair slope = estrin_slope(panel.s, x), step = (estrin(panel.s, x) - (s - panel.base)) / slope;
      if (largest(magnitude(step)) < short_step) {
        const PointPair end = x - step * (1.0 + step * estrin_second_derivative(panel.s, x) / slope);
        const PointPair u = panel.centre + end / panel.inverse_half;
        return larger(smaller(u, PointPair{u_[i + 1], u_[i + 1]}), PointPair{u_[i], u_[i]});
      }
    }
  }
  return PointPair{inverse(s[0]), inverse(s[1])};
}

double ArcLength::inverse_on(const Panel& panel, double s) const {
  const double target = s - panel.base, half = 1 / panel.inverse_half;
  if (panel.monomial > 0) {
    const double total = panel.s[panel.monomial];
    const double rho = std::pow(std::clamp(std::abs(target / total), 0.0, 1.0), 1.0 / panel.monomial);
    return panel.centre + half * (target < 0 ? -rho : rho);  // target < 0 only at the far end
  }
  const double y = (s - panel.s_middle) * panel.s_inverse_half;
  double x = std::clamp(estrin(panel.start, y), -1.0, 1.0);
  double low = -1, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double value = estrin(panel.s, x) - target, slope = estrin_slope(panel.s, x);
    (value > 0 ? high : low) = x;
    const double step = value / slope, next = x - step;
    if (std::abs(step) < short_step) {
      x = std::clamp(next - step * (step * estrin_second_derivative(panel.s, x) / slope), -1.0, 1.0);
      break;
    }
    const bool inside = next >= low && next <= high;
    x = inside ? next : 0.5 * (low + high);
    if (high - low < 1e-16) break;
  }
  return panel.centre + half * x;
}

}  // namespace bahnwerk
