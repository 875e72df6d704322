#pragma once
/// Symmetric positive definite matrices with few diagonals: A = L D Lᵀ without pivots, O(n w²). Not Eigen, which has no
/// factorisation of bands and whose sparse one (SimplicialLDLT) takes several times as long at the widths of blends, 11
/// in the plane and 17 in space: what keeps this one short is that the compiler knows the length of a column, and that
/// no sum waits for another.
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk::blending {

/// Entries up to `Width` beside the diagonal.
template <std::size_t Width>
class BandMatrix {
 public:
  explicit BandMatrix(std::size_t n) : n_(n), a_((n + Width) * (Width + 1), 0.0) {}
  void clear() { std::fill(a_.begin(), a_.end(), 0.0); }
  std::size_t size() const { return n_; }
  /// Entry of the lower half, j ≤ i ≤ j + Width. Those of one j follow each other.
  double& at(std::size_t i, std::size_t j) { return a_[j * Width + i]; }
  double at(std::size_t i, std::size_t j) const { return a_[j * Width + i]; }

  /// In place. A pivot lost to rounding is replaced, which keeps that unknown where it is. `scope` is told every
  /// few thousand columns.
  void factor(ProgressScope& scope) {
    given_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k) given_[k] = at(k, k);
    for (std::size_t k = 0; k < n_; ++k) {
      scope.work();
      double* const here = &at(k, k);
      std::array<double, Width + 1> column;
      std::copy_n(here, Width + 1, column.begin());
      if (!(column[0] > 1e-15 * given_[k])) here[0] = column[0] = 1e15 * std::max(given_[k], 1e-300);
      // Behind the last column there is room for what is not there.
      double* next = here;
      for (std::size_t i = 1; i <= Width; ++i) {
        next += Width + 1;
        const double share = here[i] = column[i] / column[0];
        for (std::size_t j = i; j <= Width; ++j) next[j - i] -= share * column[j];
      }
    }
  }

  /// x ← A⁻¹ x after factor().
  void solve(std::vector<double>& x) const {
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t i = k + 1; i < std::min(n_, k + Width + 1); ++i) x[i] -= at(i, k) * x[k];
    for (std::size_t k = n_; k-- > 0;) {
      double sum = x[k] / at(k, k);
      for (std::size_t i = k + 1; i < std::min(n_, k + Width + 1); ++i) sum -= at(i, k) * x[i];
      x[k] = sum;
    }
  }

 private:
  std::size_t n_;
  std::vector<double> a_, given_;
};

}  // namespace bahnwerk::blending
