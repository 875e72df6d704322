#pragma once
/// Derivatives of a published piece of a law, and their range, by formulas of the verifier's own.
#include <cstddef>
#include <vector>

namespace bahnwerk::verify {

/// Returns Σ c_k C(n, k) x^k (1 − x)^(n − k) by the binomial sum. O(n).
double bernstein_sum(const std::vector<double>& c, double x);
/// Returns the coefficients of the derivative of the given order over time, from differences of the position's: Δ^r b ·
/// n!/(n − r)! / T^r; {0} above the degree.
std::vector<double> derivative_coefficients(const std::vector<double>& b, double duration, int order);
/// Returns how far rounding of the coefficients of a piece may move a derivative: 16 ε of the largest one ·
/// 2^r n!/(n − r)!/T^r.
double derivative_rounding(const std::vector<double>& b, double duration, int order);

/// Returns ∫₀¹ (Σ c_k B_k(x))² dx from products of Bernstein polynomials: exact but for rounding.
double mean_square(const std::vector<double>& c);

struct EnclosedMaximum {
  double value = 0;  ///< upper bound of the maximum over [0, 1], at most `tolerance` above it
  double at = 0;
};
/// Finds the maximum by best-first bisection: a part's coefficients bound it from above.
EnclosedMaximum enclosed_maximum(const std::vector<double>& c, double tolerance);

}  // namespace bahnwerk::verify
