#pragma once
/// Loops over adjoining numbers, for lengths from 1 on: Eigen's cost more than the work itself below a length of ten.
#include <cstddef>

namespace bahnwerk {

/// Returns Σ a b as four sums side by side: additions that do not wait for each other.
inline double dot_product(const double* a, const double* b, std::size_t count) {
  double sums[4] = {0, 0, 0, 0};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4)
    for (std::size_t i = 0; i < 4; ++i) sums[i] += a[k + i] * b[k + i];
  for (; k < count; ++k) sums[0] += a[k] * b[k];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}
/// out += factor a.
inline void add_multiple(double* __restrict out, double factor, const double* __restrict a, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) out[k] += factor * a[k];
}

}  // namespace bahnwerk
