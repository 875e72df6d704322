#pragma once
/// Polynomials over [0, 1] in Bernstein form [Farouki, "The Bernstein polynomial basis: a centennial retrospective",
/// CAGD 29, 2012]: values, derivatives, division, and true extremes. Degree 21 at most; no memory is allocated.
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace bahnwerk::cam {

inline constexpr std::size_t max_coefficients = 22;
using BernsteinArray = std::array<double, max_coefficients>;

/// Returns the value at x by de Casteljau's algorithm. O(n²).
double bernstein_value(std::span<const double> b, double x);
/// Writes the coefficients of the derivative over x, b.size() − 1 of them but at least one; returns their number.
std::size_t bernstein_derivative(std::span<const double> b, double* out);
/// Splits the polynomial at x: each part is over [0, 1] again. `left` and `right` take b.size() coefficients each.
void bernstein_split(std::span<const double> b, double x, double* left, double* right);
/// Raises the degree of the coefficients from `from_degree` to `to_degree`, in place.
void bernstein_raise(double* b, std::size_t from_degree, std::size_t to_degree);

/// Smallest and largest value found so far and their places in [0, 1]; −1: an earlier value is still the best.
struct BernsteinExtremes {
  double low, high;
  double low_at = -1, high_at = -1;
};
/// Widens `known` to the true extremes of a polynomial, accurate to a few ε of the largest coefficient. Parts whose
/// coefficients lie within `known` are left out; elsewhere sign changes of the derivative isolate every extremum.
void take_extremes(std::span<const double> b, BernsteinExtremes& known);

}  // namespace bahnwerk::cam
