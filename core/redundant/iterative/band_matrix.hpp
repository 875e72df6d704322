#pragma once
/// Symmetric band matrices and their Cholesky factor: what sums of rows of few neighbouring variables make.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/redundant/iterative/spline_ends.hpp"

namespace bahnwerk {

/// n rows, `band` diagonals below the main one. Memory n (band + 1).
class BandMatrix {
 public:
  BandMatrix(std::size_t n, std::size_t band) : n_(n), stride_(band + 1), a_(n * stride_, 0.0) {}
  std::size_t size() const { return n_; }
  void clear() { std::fill(a_.begin(), a_.end(), 0.0); }
  /// Entry (i, i − d), 0 ≤ d ≤ band.
  double& at(std::size_t i, std::size_t d) { return a_[i * stride_ + d]; }
  double at(std::size_t i, std::size_t d) const { return a_[i * stride_ + d]; }
  /// += weight · row rowᵀ.
  void add(const VariableRow& row, double weight) { add(row.first, row.count, row.weights.data(), weight); }
  /// += weight · row rowᵀ for the row of `count` weights from variable `first` on.
  void add(std::size_t first, std::size_t count, const double* weights, double weight) {
    switch (count) {  // constants save 6 to 8 % of a whole plan's time
      case 2:
        return add_of<2>(first, weights, weight, 2);
      case 3:
        return add_of<3>(first, weights, weight, 3);
      case 4:
        return add_of<4>(first, weights, weight, 4);
      case 5:
        return add_of<5>(first, weights, weight, 5);
      default:
        return add_of<0>(first, weights, weight, count);
    }
  }
  void add(const BandMatrix& other, double weight) {
    for (std::size_t k = 0; k < a_.size(); ++k) a_[k] += weight * other.a_[k];
  }
  /// out += A x.
  void multiply(const std::vector<double>& x, std::vector<double>& out) const {
    for (std::size_t i = 0; i < n_; ++i) {
      out[i] += at(i, 0) * x[i];
      for (std::size_t d = 1; d < stride_ && d <= i; ++d) {
        out[i] += at(i, d) * x[i - d];
        out[i - d] += at(i, d) * x[i];
      }
    }
  }
  /// Becomes its Cholesky factor L. False where it is not positive definite but for rounding. O(n band²).
  bool factor() {
    switch (stride_) {
      case 3:
        return factor_of<3>();
      case 4:
        return factor_of<4>();
      case 5:
        return factor_of<5>();
      default:
        return factor_of<0>();
    }
  }
  /// Solves with a factor: x becomes (L Lᵀ)⁻¹ x.
  void solve(std::vector<double>& x) const {
    switch (stride_) {
      case 3:
        return solve_of<3>(x);
      case 4:
        return solve_of<4>(x);
      case 5:
        return solve_of<5>(x);
      default:
        return solve_of<0>(x);
    }
  }

 private:
  // The first template argument: the row's count, the stride; 0: known at run time alone.
  template <std::size_t C>
  void add_of(std::size_t first, const double* weights, double weight, std::size_t any) {
    const std::size_t count = C > 0 ? C : any;
    double* entry = &at(first, 0);
    for (std::size_t i = 0; i < count; ++i, entry += stride_) {
      const double w = weight * weights[i];
      for (std::size_t d = 0; d <= i; ++d) entry[d] += w * weights[i - d];
    }
  }
  template <std::size_t S>
  bool factor_of() {
    const std::size_t stride = S > 0 ? S : stride_;
    constexpr double least = 1e-15;  // least pivot, relative to the diagonal entry that it was
    for (std::size_t i = 0; i < n_; ++i) {
      double* const row = &a_[i * stride];  // row[d]: entry (i, i − d)
      const std::size_t before = std::min<std::size_t>(i, stride - 1);
      for (std::size_t d = before; d > 0; --d) {  // column j = i − d
        const double* const other = row - d * stride;
        double sum = row[d];
        for (std::size_t k = before; k > d; --k) sum -= row[k] * other[k - d];
        row[d] = sum / other[0];
      }
      double sum = row[0];
      for (std::size_t k = before; k > 0; --k) sum -= row[k] * row[k];
      if (!(sum > least * row[0])) return false;
      row[0] = std::sqrt(sum);
    }
    return true;
  }
  template <std::size_t S>
  void solve_of(std::vector<double>& x) const {
    const std::size_t stride = S > 0 ? S : stride_;
    for (std::size_t i = 0; i < n_; ++i) {
      const double* const row = &a_[i * stride];
      for (std::size_t d = 1; d < stride && d <= i; ++d) x[i] -= row[d] * x[i - d];
      x[i] /= row[0];
    }
    for (std::size_t i = n_; i-- > 0;) {
      const double* const row = &a_[i * stride];
      x[i] /= row[0];
      for (std::size_t d = 1; d < stride && d <= i; ++d) x[i - d] -= row[d] * x[i];
    }
  }

  std::size_t n_, stride_;
  std::vector<double> a_;
};

}  // namespace bahnwerk
