#pragma once
/// A polynomial with its first three derivatives over a disc in the complex plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numeric/disc.hpp"
#include "core/numeric/polynomial.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk {

/// Encloses p^(n)(x)/n!, n = 0 … 3, for all complex |x − at| ≤ radius: Taylor coefficients about `at`, and the sizes of
/// those behind them. Degree 31 at most. Rounding is included. O(degree): 4 passes of Horner's scheme.
inline Taylor<3, Disc> enclose(const Polynomial& p, double at, double radius) {
  constexpr std::size_t orders = 4, most_terms = 32;
  Taylor<3, Disc> result;
  const std::size_t count = std::min(p.size(), most_terms);
  if (count == 0) return result;
  std::array<double, most_terms> c, size;
  std::copy_n(p.begin(), count, c.begin());
  for (std::size_t k = 0; k < count; ++k) size[k] = std::abs(c[k]);
  const double reach = std::abs(at) + radius;
  const double rounding = 4 * static_cast<double>(count) * std::numeric_limits<double>::epsilon();
  // Of the derivative one order above, on the whole disc, by its sizes about `at`: so all coefficients are needed.
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t k = count - 1; k > n; --k) c[k - 1] += at * c[k], size[k - 1] += reach * size[k];
  for (std::size_t n = 0; n < std::min(count, orders); ++n) result.c[n].centre = c[n];
  std::array<double, most_terms> off;
  for (std::size_t k = 0; k < count; ++k) off[k] = std::abs(c[k]);
  for (std::size_t n = 0; n < std::min(count, orders); ++n) {
    for (std::size_t k = count - 1; k > n; --k) off[k - 1] += radius * off[k];
    result.c[n].radius = std::max(0.0, off[n] - std::abs(c[n])) + rounding * size[n];
  }
  return result;
}

}  // namespace bahnwerk
