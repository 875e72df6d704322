#pragma once
/// Chebyshev series on an interval: Σ c_k T_k(x), x = (2u − a − b)/(b − a).
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bahnwerk {

/// A polynomial by its Chebyshev coefficients.
class Chebyshev {
 public:
  /// Takes the series with coefficients c (at least one; c₀ counts fully) on [a, b], a < b.
  Chebyshev(double a, double b, std::vector<double> coefficients);

  /// Interpolates f at the degree + 1 Chebyshev–Lobatto points (the ends included), degree ≥ 1. O(degree²).
  template <class F>
  static Chebyshev fit(F&& f, double a, double b, std::size_t degree) {
    std::vector<double> samples;
    samples.reserve(degree + 1);
    for (double x : lobatto(degree)) samples.push_back(f(0.5 * (a + b) + 0.5 * (b - a) * x));
    return {a, b, from_samples(samples)};
  }
  /// Returns cos(jπ/degree), j = 0 … degree: descending from 1 to −1, exactly symmetric.
  static std::vector<double> lobatto(std::size_t degree);
  /// Returns the coefficients of the interpolant through values at those points.
  static std::vector<double> from_samples(const std::vector<double>& values);

  double begin() const { return a_; }
  double end() const { return b_; }
  const std::vector<double>& coefficients() const { return c_; }
  /// Evaluates by Clenshaw's recurrence, O(degree).
  double operator()(double u) const;
  Chebyshev derivative() const;
  /// Returns the antiderivative that vanishes at begin().
  Chebyshev integral() const;
  /// Returns Σ |c_k| ≥ |value| everywhere on the interval.
  double bound() const;
  /// Returns Σ |c_k| over k ≥ first, which bounds the error of truncating the series there.
  double tail(std::size_t first) const;
  /// Returns the coefficients of 1, x, x² … of the polynomial. Loses digits when the c_k do not decay (factor up to
  /// 2.4ⁿ).
  std::vector<double> power_basis() const;

 private:
  double a_, b_;
  std::vector<double> c_;
};

}  // namespace bahnwerk
