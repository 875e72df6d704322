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
#include "core/numeric/with_constant.hpp"

namespace bahnwerk {

/// Stores entries up to `Width` beside the diagonal; with Width = 0, up to a width of 0 to 6 that the constructor
/// takes.
template <std::size_t Width = 0>
class SymmetricBand {
 public:
  explicit SymmetricBand(std::size_t n = 0, std::size_t width = Width) : width_(width) { reset(n); }
  /// Becomes the zero matrix of n rows; keeps its memory.
  void reset(std::size_t n) {
    n_ = n;
    a_.assign((n + width()) * (width() + 1), 0.0);
  }
  std::size_t size() const { return n_; }
  std::size_t width() const { return Width > 0 ? Width : width_; }
  /// Returns an entry of the lower half, j ≤ i ≤ j + width. Entries of one column j are contiguous.
  double& at(std::size_t i, std::size_t j) { return a_[j * width() + i]; }
  double at(std::size_t i, std::size_t j) const { return a_[j * width() + i]; }

  /// Returns the address of the entries (j, j) … (j + width, j).
  double* column(std::size_t j) { return &a_[j * (width() + 1)]; }
  const double* column(std::size_t j) const { return &a_[j * (width() + 1)]; }

  /// += weight · other, a matrix of equal size and width.
  void add(const SymmetricBand& other, double weight) {
    for (std::size_t k = 0; k < a_.size(); ++k) a_[k] += weight * other.a_[k];
  }
  /// += weight · row rowᵀ for the row of `count` ≤ 6 numbers from unknown `first` on.
  void add(std::size_t first, std::size_t count, const double* row, double weight) {
    with_constant(count, [&](auto length) {
      double* entry = column(first);
      for (std::size_t j = 0; j < length; ++j, entry += width() + 1) {
        const double share = weight * row[j];
        for (std::size_t i = j; i < length; ++i) entry[i - j] += share * row[i];
      }
    });
  }
  /// out += A x. To be called before factor().
  void multiply(const std::vector<double>& x, std::vector<double>& out) const {
    for (std::size_t j = 0; j < n_; ++j) {
      out[j] += at(j, j) * x[j];
      for (std::size_t i = j + 1; i < std::min(n_, j + width() + 1); ++i) {
        out[i] += at(i, j) * x[j];
        out[j] += at(i, j) * x[i];
      }
    }
  }

  /// Factors in place; returns whether the matrix is positive definite but for rounding. A pivot that is not positive
  /// but for rounding is replaced, which leaves that unknown unchanged. Calls tick() for every column.
  template <class Tick>
  [[gnu::always_inline]] bool factor(Tick&& tick) {
    if constexpr (Width > 0)
      return factor_of<Width>(tick);
    else
      return with_constant(width_, [&](auto width) { return factor_of<width>(tick); });
  }
  [[gnu::always_inline]] bool factor() {
    return factor([] {});
  }

  /// Replaces x by A⁻¹ x. To be called after factor().
  [[gnu::always_inline]] void solve(std::vector<double>& x) const {
    if constexpr (Width > 0)
      solve_of<Width>(x);
    else
      with_constant(width_, [&](auto width) { solve_of<width>(x); });
  }

 private:
  template <std::size_t W>
  using Column = std::array<double, W + 1>;

  template <std::size_t W, class Tick>
  [[gnu::always_inline]] bool factor_of(Tick&& tick) {
    bool definite = true;
    given_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) given_[k] = at(k, k);
    for (std::size_t k = 0; k < n_; ++k) {
      tick();
      double* const here = &a_[k * (W + 1)];
      if (!(here[0] > 1e-15 * given_[k])) {
        here[0] = 1e15 * std::max(given_[k], 1e-300);
        definite = false;
      }
      Column<W> below, share;
      std::copy_n(here, W + 1, below.begin());
      const double inverse = 1 / here[0];
      for (std::size_t i = 1; i <= W; ++i) here[i] = share[i] = below[i] * inverse;
      // Room behind the last column replaces the entries that do not exist.
      eliminate<W>(here, below, share, std::make_index_sequence<W>());
    }
    return definite;
  }
  template <std::size_t W>
  [[gnu::always_inline]] void solve_of(std::vector<double>& x) const {
    x.resize(n_ + W, 0.0);
    for (std::size_t k = 0; k < n_; ++k) {
      const double* const below = &a_[k * (W + 1)];
      double* const here = &x[k];
      const double known = here[0];
      for (std::size_t i = 1; i <= W; ++i) here[i] -= below[i] * known;
    }
    std::fill(x.begin() + static_cast<std::ptrdiff_t>(n_), x.end(), 0.0);
    for (std::size_t k = n_; k-- > 0;) {
      const double* const below = &a_[k * (W + 1)];
      double* const here = &x[k];
      // The unknown computed last is added last, so that the other products need not wait for it.
      std::array<double, 4> sum{};
      for (std::size_t i = W; i > 1; --i) sum[i % 4] += below[i] * here[i];
      here[0] = here[0] / below[0] - ((sum[0] + sum[1]) + (sum[2] + sum[3]));
      if constexpr (W > 0) here[0] -= below[1] * here[1];
    }
    x.resize(n_);
  }
  /// The compiler knows the length of every loop and computes several iterations at once.
  template <std::size_t W, std::size_t... I>
  [[gnu::always_inline]] static void eliminate(double* here, const Column<W>& below, const Column<W>& share,
                                               std::index_sequence<I...>) {
    (eliminate<W, I + 1>(here + (I + 1) * (W + 1), below, share[I + 1]), ...);
  }
  template <std::size_t W, std::size_t I>
  [[gnu::always_inline]] static void eliminate(double* column, const Column<W>& below, double share) {
    for (std::size_t j = I; j <= W; ++j) column[j - I] -= share * below[j];
  }

  std::size_t n_ = 0, width_;
  LargeVector<double> a_;
  std::vector<double> given_;
};

}  // namespace bahnwerk
