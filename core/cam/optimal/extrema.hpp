#pragma once
/// Extrema of polynomials in Bernstein form: all of them for the exchange of points, the largest value as an enclosure.
#include <span>
#include <vector>

namespace bahnwerk::cam {

struct Extremum {
  double at;     ///< parameter, [0, 1]
  double value;  ///< the polynomial's, with its sign
};
/// Local extrema and both ends, rising in `at`. Two that lie closer than a seventh of what Chebyshev points of the
/// degree are apart may be missed. Cost: O(degree²) and O(degree · 40) per extremum.
void find_extrema(std::span<const double> bernstein, std::vector<Extremum>& out);

/// max p over [0, 1] from above: at most 1e-13 of the largest coefficient more than the maximum. Subdivision; the
/// Bernstein coefficients enclose what they belong to (Farouki, CAGD 29, 2012).
Extremum greatest_value(std::span<const double> bernstein);
/// max |p| over [0, 1] from above, as close; `value` is not negative.
Extremum greatest_magnitude(std::span<const double> bernstein);

/// de Casteljau. O(degree²).
double evaluate_bernstein(std::span<const double> bernstein, double v);

}  // namespace bahnwerk::cam
