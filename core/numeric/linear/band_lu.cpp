#include "core/numeric/linear/band_lu.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numeric/linear/vector_loops.hpp"

namespace bahnwerk {

void BandLu::reset(std::size_t n, std::size_t lower, std::size_t upper) {
  n_ = n, lower_ = lower, upper_ = upper, width_ = 2 * lower + upper + 1;
  a_.assign(n * width_, 0.0);
  pivot_ratio_ = 0;
}

bool BandLu::factor(double least) {
  constexpr double rounding = 1e-17;
  pivots_.resize(n_);
  double largest = 0;
  for (const double value : a_) largest = std::max(largest, std::abs(value));
  if (largest == 0) return n_ == 0;
  double smallest = largest;
  std::size_t reach = 0;  // last column that a row so far has
  for (std::size_t k = 0; k < n_; ++k) {
    const std::size_t last = last_row(k);
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i <= last; ++i)
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    pivots_[k] = pivot;
    reach = std::max(reach, std::min(n_ - 1, pivot + upper_));
    const double size = std::abs(at(pivot, k));
    if (std::isnan(size)) return false;
    smallest = std::min(smallest, size);
    if (size <= least * largest) at(pivot, k) = rounding * largest;
    if (pivot != k)
      for (std::size_t j = k; j <= reach; ++j) std::swap(at(k, j), at(pivot, j));
    const double inverse = 1 / at(k, k);
    const double* const top = &at(k, k);
    for (std::size_t i = k + 1; i <= last; ++i) {
      double* const row = &at(i, k);
      if (row[0] == 0) continue;
      const double factor = row[0] *= inverse;
      add_multiple(row + 1, -factor, top + 1, reach - k);
    }
  }
  pivot_ratio_ = smallest / largest;
  return true;
}

void BandLu::solve(double* x) const {
  for (std::size_t k = 0; k < n_; ++k) {
    if (pivots_[k] != k) std::swap(x[k], x[pivots_[k]]);
    const double value = x[k];
    if (value == 0) continue;
    for (std::size_t i = k + 1, last = last_row(k); i <= last; ++i) x[i] -= at(i, k) * value;
  }
  for (std::size_t k = n_; k-- > 0;) {
    const double* const row = &a_[k * width_ + lower_];
    x[k] = (x[k] - dot_product(row + 1, x + k + 1, last_column(k) - k)) / row[0];
  }
}

void BandLu::solve_transposed(double* x) const {
  for (std::size_t k = 0; k < n_; ++k) {
    const double* const row = &a_[k * width_ + lower_];
    x[k] /= row[0];
    add_multiple(x + k + 1, -x[k], row + 1, last_column(k) - k);
  }
  for (std::size_t k = n_; k-- > 0;) {
    for (std::size_t i = k + 1, last = last_row(k); i <= last; ++i) x[k] -= at(i, k) * x[i];
    std::swap(x[k], x[pivots_[k]]);
  }
}

void BandLu::solve(double* x, std::size_t columns) const {
  const auto row = [&](std::size_t i) { return x + i * columns; };
  for (std::size_t k = 0; k < n_; ++k) {
    if (pivots_[k] != k) std::swap_ranges(row(k), row(k) + columns, row(pivots_[k]));
    for (std::size_t i = k + 1, last = last_row(k); i <= last; ++i)
      if (const double factor = at(i, k); factor != 0) add_multiple(row(i), -factor, row(k), columns);
  }
  for (std::size_t k = n_; k-- > 0;) {
    for (std::size_t j = k + 1, last = last_column(k); j <= last; ++j)
      if (const double factor = at(k, j); factor != 0) add_multiple(row(k), -factor, row(j), columns);
    const double pivot = at(k, k);
    for (std::size_t j = 0; j < columns; ++j) row(k)[j] /= pivot;
  }
}

}  // namespace bahnwerk
