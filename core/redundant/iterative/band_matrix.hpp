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
  void add(const VariableRow& row, double weight) {
    for (std::size_t i = 0; i < row.count; ++i) {
      const double w = weight * row.weights[i];
      double* entry = &at(row.first + i, 0);
      for (std::size_t d = 0; d <= i; ++d) entry[d] += w * row.weights[i - d];
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
    constexpr double least = 1e-15;  // of the diagonal entry that the pivot was
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t lowest = i + 1 > stride_ ? i + 1 - stride_ : 0;
      for (std::size_t j = lowest; j <= i; ++j) {
        double sum = at(i, i - j);
        const std::size_t from = std::max(lowest, j + 1 > stride_ ? j + 1 - stride_ : 0);
        for (std::size_t k = from; k < j; ++k) sum -= at(i, i - k) * at(j, j - k);
        if (j < i) {
          at(i, i - j) = sum / at(j, 0);
        } else {
          if (!(sum > least * at(i, 0))) return false;
          at(i, 0) = std::sqrt(sum);
        }
      }
    }
    return true;
  }
  /// Of a factor: x becomes (L Lᵀ)⁻¹ x.
  void solve(std::vector<double>& x) const {
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t d = 1; d < stride_ && d <= i; ++d) x[i] -= at(i, d) * x[i - d];
      x[i] /= at(i, 0);
    }
    for (std::size_t i = n_; i-- > 0;) {
      x[i] /= at(i, 0);
      for (std::size_t d = 1; d < stride_ && d <= i; ++d) x[i - d] -= at(i, d) * x[i];
    }
  }

 private:
  std::size_t n_, stride_;
  std::vector<double> a_;
};

}  // namespace bahnwerk
