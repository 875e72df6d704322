#pragma once
/// A polynomial of time in Bernstein form, which encloses it (Farouki, "The Bernstein polynomial basis: a centennial
/// retrospective", CAGD 29, 2012).
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/numeric/peak.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk::verify {

using Bernstein = std::array<double, max_coefficients>;

/// Writes the Bernstein coefficients over [0, 1] of p(T x), the constant increased by `offset`. Returns their number,
/// at most max_coefficients.
inline std::size_t bernstein(const Polynomial& p, double duration, double offset, Bernstein& b) {
  const std::size_t n = std::max<std::size_t>(p.size(), 1);
  Bernstein scaled{};
  double power = 1, choose_n = 1;  // C(n − 1, i)
  for (std::size_t i = 0; i < n; ++i) {
    scaled[i] = (i < p.size() ? p[i] : 0) * power / choose_n;
    power *= duration;
    choose_n *= static_cast<double>(n - 1 - i) / static_cast<double>(i + 1);
  }
  scaled[0] += offset;
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0, choose = 1;  // C(j, i)
    for (std::size_t i = 0; i <= j; ++i) {
      sum += choose * scaled[i];
      choose *= static_cast<double>(j - i) / static_cast<double>(i + 1);
    }
    b[j] = sum;
  }
  return n;
}

}  // namespace bahnwerk::verify
