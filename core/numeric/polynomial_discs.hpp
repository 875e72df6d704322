#pragma once
/// Polynomials with their first three derivatives over a disc in the complex plane.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numeric/disc.hpp"
#include "core/numeric/lanes.hpp"
#include "core/numeric/polynomial.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk {

/// Encloses p^(n)(x)/n! and q^(n)(x)/n!, n = 0 … 3, for all complex |x − at| ≤ radius, by Taylor coefficients about
/// `at` and the magnitudes of the higher ones. The degree is at most 31. Rounding is included. O(degree²); both take as
/// long as one.
inline std::array<Taylor<3, Disc>, 2> enclose(const Polynomial& p, const Polynomial& q, double at, double radius) {
  using Both = Lanes<2>;
  constexpr std::size_t orders = 4, most_terms = 32;
  std::array<Taylor<3, Disc>, 2> result;
  const std::array<std::size_t, 2> own{std::min(p.size(), most_terms), std::min(q.size(), most_terms)};
  const std::size_t count = std::max(own[0], own[1]), known = std::min(count, orders);
  if (count == 0) return result;
  std::array<Both, most_terms> c, size, off;
  for (std::size_t k = 0; k < count; ++k) {
    c[k] = Both{k < own[0] ? p[k] : 0, k < own[1] ? q[k] : 0};
    size[k] = magnitude(c[k]);
  }
  const double reach = std::abs(at) + radius;
  // The derivative one order higher is bounded on the whole disc by its magnitudes about `at`, which needs all
  // coefficients.
  for (std::size_t n = 0; n < known; ++n)
    for (std::size_t k = count - 1; k > n; --k) c[k - 1] += at * c[k], size[k - 1] += reach * size[k];
  for (std::size_t n = known; n < count; ++n)
    for (std::size_t k = count - 1; k > n; --k) c[k - 1] += at * c[k];
  for (std::size_t k = 0; k < count; ++k) off[k] = magnitude(c[k]);
  for (std::size_t n = 0; n < known; ++n) {
    for (std::size_t k = count - 1; k > n; --k) off[k - 1] += radius * off[k];
    for (std::size_t i = 0; i < 2; ++i) {
      if (n >= own[i]) continue;
      const double rounding = 4 * static_cast<double>(own[i]) * std::numeric_limits<double>::epsilon();
      result[i].c[n] = {c[n][i], std::max(0.0, off[n][i] - std::abs(c[n][i])) + rounding * size[n][i]};
    }
  }
  return result;
}

inline Taylor<3, Disc> enclose(const Polynomial& p, double at, double radius) { return enclose(p, {}, at, radius)[0]; }

}  // namespace bahnwerk
