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

/// de Casteljau, O(n²).
double bernstein_value(std::span<const double> b, double x);
/// Coefficients of the derivative over x, b.size() − 1 of them, at least one; how many.
std::size_t bernstein_derivative(std::span<const double> b, double* out);
/// The parts before and behind x, each over [0, 1] again. `left` and `right` take b.size() coefficients each.
void bernstein_split(std::span<const double> b, double x, double* left, double* right);
/// Coefficients with the degree raised to `degree`, in place.
void bernstein_raise(double* b, std::size_t from_degree, std::size_t to_degree);

/// Smallest and largest value found so far and where, in [0, 1]; −1: what was known before is still the best.
struct BernsteinExtremes {
  double low, high;
  double low_at = -1, high_at = -1;
};
/// Takes in the true extremes of a polynomial: parts whose coefficients lie within what is known are left out;
/// elsewhere its derivative's sign changes isolate every extremum. To a few ε of the largest coefficient.
void take_extremes(std::span<const double> b, BernsteinExtremes& known);

}  // namespace bahnwerk::cam
