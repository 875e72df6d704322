#pragma once
/// Symmetric positive definite band matrices: A = L D Lᵀ without pivoting (Golub & Van Loan, "Matrix Computations",
/// 4.3.5), O(n w²). Eigen has no band factorisation, and its sparse one (SimplicialLDLT) takes several times as long at
/// widths of 11 and 17. This one is fast because the compiler knows the length of a column, and because no sum depends
/// on another. The kernels are inlined into their callers, where the compiler may use wider registers.
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// Stores entries up to `Width` beside the diagonal.
template <std::size_t Width>
class SymmetricBand {
 public:
  explicit SymmetricBand(std::size_t n = 0) { reset(n); }
  /// Becomes the zero matrix of n rows; keeps its memory.
  void reset(std::size_t n) {
    n_ = n;
    a_.assign((n + Width) * (Width + 1), 0.0);
  }
  std::size_t size() const { return n_; }
  /// Returns an entry of the lower half, j ≤ i ≤ j + Width. Entries of one column j are contiguous.
  double& at(std::size_t i, std::size_t j) { return a_[j * Width + i]; }
  double at(std::size_t i, std::size_t j) const { return a_[j * Width + i]; }

  /// Returns the address of the entries (j, j) … (j + Width, j).
  double* column(std::size_t j) { return &a_[j * (Width + 1)]; }
  const double* column(std::size_t j) const { return &a_[j * (Width + 1)]; }

  /// Factors in place. A pivot that rounding has made non-positive is replaced, which leaves that unknown unchanged.
  /// Calls tick() for every column.
  template <class Tick>
  [[gnu::always_inline]] void factor(Tick&& tick) {
    given_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) given_[k] = at(k, k);
    for (std::size_t k = 0; k < n_; ++k) {
      tick();
      double* const here = column(k);
      if (!(here[0] > 1e-15 * given_[k])) here[0] = 1e15 * std::max(given_[k], 1e-300);
      std::array<double, Width + 1> below, share;
      std::copy_n(here, Width + 1, below.begin());
      const double inverse = 1 / here[0];
      for (std::size_t i = 1; i <= Width; ++i) here[i] = share[i] = below[i] * inverse;
      // Room behind the last column replaces the entries that do not exist.
      eliminate(here, below, share, std::make_index_sequence<Width>());
    }
  }

  /// Replaces x by A⁻¹ x. To be called after factor().
  [[gnu::always_inline]] void solve(std::vector<double>& x) const {
    x.resize(n_ + Width, 0.0);
    for (std::size_t k = 0; k < n_; ++k) {
      const double* const below = column(k);
      double* const here = &x[k];
      const double known = here[0];
      for (std::size_t i = 1; i <= Width; ++i) here[i] -= below[i] * known;
    }
    std::fill(x.begin() + static_cast<std::ptrdiff_t>(n_), x.end(), 0.0);
    for (std::size_t k = n_; k-- > 0;) {
      const double* const below = column(k);
      double* const here = &x[k];
      // The unknown computed last is added last, so that the other products need not wait for it.
      std::array<double, 4> sum{};
      for (std::size_t i = Width; i > 1; --i) sum[i % 4] += below[i] * here[i];
      here[0] = here[0] / below[0] - ((sum[0] + sum[1]) + (sum[2] + sum[3])) - below[1] * here[1];
    }
    x.resize(n_);
  }

 private:
  using Column = std::array<double, Width + 1>;
  /// The compiler knows the length of every loop and computes several iterations at once.
  template <std::size_t... I>
  [[gnu::always_inline]] static void eliminate(double* here, const Column& below, const Column& share,
                                               std::index_sequence<I...>) {
    (eliminate<I + 1>(here + (I + 1) * (Width + 1), below, share[I + 1]), ...);
  }
  template <std::size_t I>
  [[gnu::always_inline]] static void eliminate(double* column, const Column& below, double share) {
    for (std::size_t j = I; j <= Width; ++j) column[j - I] -= share * below[j];
  }

  std::size_t n_ = 0;
  LargeVector<double> a_;
  std::vector<double> given_;
};

}  // namespace bahnwerk
