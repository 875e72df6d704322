#pragma once
/// Extrema of polynomials in Bernstein form: all of them for the exchange of points, the largest value as an enclosure.
#include <span>
#include <vector>

namespace bahnwerk::cam {

struct Extremum {
  double at;     ///< parameter, [0, 1]
  double value;  ///< value of the polynomial, with its sign
};
/// Finds the local extrema, and both ends, in ascending order of `at`. Two that lie closer than a seventh of the
/// distance of Chebyshev points of the degree may be missed. Cost: O(degree²), and O(degree · 40) per extremum.
void find_extrema(std::span<const double> bernstein, std::vector<Extremum>& out);

/// Returns an upper bound of max p over [0, 1], by at most 1e-13 of the largest coefficient too large. It subdivides
/// the interval, on whose parts Bernstein coefficients enclose the polynomial (Farouki, CAGD 29, 2012).
Extremum greatest_value(std::span<const double> bernstein);
/// Returns an upper bound of max |p| over [0, 1] of the same accuracy; `value` is not negative.
Extremum greatest_magnitude(std::span<const double> bernstein);

/// Returns the value at v by de Casteljau's algorithm. O(degree²).
double evaluate_bernstein(std::span<const double> bernstein, double v);

}  // namespace bahnwerk::cam
