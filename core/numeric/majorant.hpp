#pragma once
/// Numbers that carry bounds of a function's derivatives over a ball. A formula written once then gives bounds, too.
///
/// A function f of n variables is considered over the complex ball |z − centre| ≤ radius (norm of a complex vector). A
/// Majorant<N> contains f at the real centre and m_1 … m_N with |∂ⁿf/∂eⁿ| ≤ n! m_n for every point of the ball and
/// every complex direction e of unit length, so |f(z) − f(centre)| ≤ m_1 radius. Sums and products of such series bound
/// sums and products of functions; f(g) is bounded by what f's derivatives allow about g(centre) [Cauchy's majorants;
/// Krantz, Parks, "A Primer of Real Analytic Functions", 2nd ed., 2002, section 1.4]. Where the ball may reach a
/// singularity bounds are infinite. Bounds are proven but for rounding, 1e-15 of their size.
///
/// The type has the functions of Taylor (core/numeric/taylor.hpp). Cost: O(N²) per operation, O(N³) for sin, cos, sqrt,
/// /.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/numeric/sine_cosine.hpp"

namespace bahnwerk {

/// Bounds of a function and of its derivatives up to order N.
template <std::size_t N>
class Majorant {
 public:
  Majorant() = default;
  Majorant(double constant) : centre_(constant) {  // NOLINT: constants are used in formulas like numbers
    m_[0] = std::abs(constant);
  }
  /// Returns a coordinate of the space over a ball about it: |∂/∂e| ≤ `slope`.
  static Majorant coordinate(double centre, double radius, double slope = 1) {
    Majorant x(centre);
    x.radius_ = radius;
    x.m_[1] = slope;
    return x.sized(infinite);
  }
  double centre() const { return centre_; }
  /// Returns an upper bound of the magnitude of the n-th derivative, n = 1 … N.
  double derivative(std::size_t n) const {
    double factorial = 1;
    for (std::size_t i = 2; i <= n; ++i) factorial *= static_cast<double>(i);
    return factorial * m_[n];
  }
  /// Returns a bound of the distance from the value at the centre.
  double off() const { return times(m_[1], radius_); }

  friend Majorant operator-(Majorant a) {
    a.centre_ = -a.centre_;
    return a;
  }
  friend Majorant operator+(const Majorant& a, const Majorant& b) {
    Majorant r = joined(a, b, a.centre_ + b.centre_);
    for (std::size_t n = 1; n <= N; ++n) r.m_[n] = a.m_[n] + b.m_[n];
    return r.sized(a.m_[0] + b.m_[0]);
  }
  friend Majorant operator-(const Majorant& a, const Majorant& b) { return a + -b; }
  friend Majorant operator*(const Majorant& a, const Majorant& b) {
    Majorant r = joined(a, b, a.centre_ * b.centre_);
    for (std::size_t n = 1; n <= N; ++n)
      for (std::size_t i = 0; i <= n; ++i) r.m_[n] += times(a.m_[i], b.m_[n - i]);
    return r.sized(times(a.m_[0], b.m_[0]));
  }
  friend Majorant operator/(const Majorant& a, const Majorant& b) { return a * b.reciprocal(); }
  /// The value at the centre has to be positive.
  friend Majorant sqrt(const Majorant& a) {
    const double least = a.centre_ - a.off();
    Series f{};
    double binomial = 1, power = std::sqrt(std::max(least, 0.0));
    for (std::size_t n = 1; n <= N; ++n) {
      binomial *= std::abs(1.5 - static_cast<double>(n)) / static_cast<double>(n), power /= least;
      f[n] = least > 0 ? binomial * power : infinite;
    }
    return a.through(std::sqrt(a.centre_), f);
  }
  friend Majorant sin(const Majorant& a) { return a.wave(std::sin(a.centre_)); }
  friend Majorant cos(const Majorant& a) { return a.wave(std::cos(a.centre_)); }
  friend SineCosine<Majorant> sine_cosine(const Majorant& a) { return {sin(a), cos(a)}; }
  friend Majorant atan2(const Majorant& y, const Majorant& x) {
    return atan2(y, x, (derived(y) * x + derived(x) * y) / (x * x + y * y));  // + bounds the difference
  }
  friend Majorant atan2(const Majorant& y, const Majorant& x, const Majorant& slope) {
    return integral(std::atan2(y.centre_, x.centre_), slope);
  }
  friend Majorant acos(const Majorant& a) {
    return integral(std::acos(a.centre_), derived(a) / sqrt(Majorant(1) - a * a));
  }

  /// Returns the derivative along e as a function of its own, whose value at the centre depends on e. Its N-th
  /// derivative is lost.
  friend Majorant derived(const Majorant& a) {
    Majorant r;
    r.centre_ = std::numeric_limits<double>::quiet_NaN();
    r.radius_ = a.radius_;
    for (std::size_t n = 0; n < N; ++n) r.m_[n] = static_cast<double>(n + 1) * a.m_[n + 1];
    return r;
  }

 private:
  using Series = std::array<double, N + 1>;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  static double times(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }  // 0 times an unknown bound is 0
  static Majorant joined(const Majorant& a, const Majorant& b, double centre) {
    Majorant r(centre);
    r.radius_ = std::max(a.radius_, b.radius_);
    return r;
  }
  /// Returns the series with a bound of its magnitude over the ball as the constant; `most` is one such bound.
  Majorant sized(double most) {
    const double about = std::abs(centre_) + off();
    m_[0] = about < most ? about : most;  // the centre may be unknown, NaN
    return *this;
  }
  /// Returns f(a) from f at a's centre and bounds of |f^(n)|/n! over the range of a: Σ f_n (Σ m_i x^i)^n, truncated
  /// behind x^N.
  Majorant through(double value, const Series& f) const {
    Majorant r(value);
    r.radius_ = radius_;
    Series power = m_;  // powers of the series without its constant
    power[0] = 0;
    for (std::size_t n = 1; n <= N; ++n) {
      for (std::size_t i = n; i <= N; ++i) r.m_[i] += times(f[n], power[i]);
      Series next{};
      for (std::size_t i = n + 1; i <= N; ++i)
        for (std::size_t j = 1; j + n <= i; ++j) next[i] += times(m_[j], power[i - j]);
      power = next;
    }
    return r.sized(infinite);
  }
  Majorant wave(double value) const {
    Series f{};
    double most = std::cosh(off());  // |sin|, |cos| ≤ cosh of the imaginary part
    for (std::size_t n = 1; n <= N; ++n) f[n] = most /= static_cast<double>(n);
    return through(value, f);
  }
  Majorant reciprocal() const {
    const double least = std::abs(centre_) - off();
    Series f{};
    double power = 1 / least;
    for (std::size_t n = 1; n <= N; ++n) f[n] = least > 0 ? power /= least : infinite;
    return through(1 / centre_, f);
  }
  static Majorant integral(double value, const Majorant& slope) {
    Majorant r(value);
    r.radius_ = slope.radius_;
    for (std::size_t n = 1; n <= N; ++n) r.m_[n] = slope.m_[n - 1] / static_cast<double>(n);
    return r.sized(infinite);
  }

  double centre_ = 0, radius_ = 0;
  Series m_{};  ///< bounds over the ball of |f| and of its derivatives/n!
};

}  // namespace bahnwerk
