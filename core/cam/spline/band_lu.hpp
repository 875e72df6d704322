#pragma once
/// LU factors of a square matrix whose nonzeros lie near the diagonal, with row exchanges [Golub & Van Loan, Matrix
/// Computations, 4.3], its condition number, and its null vectors where it is singular.
#include <cstddef>
#include <vector>

namespace bahnwerk::cam {

class BandLu {
 public:
  /// Entries (row, column, value) of an n × n matrix; entries of one place are added.
  struct Entry {
    std::size_t row, column;
    double value;
  };
  /// Factorises the matrix. O(n · bandwidth²).
  BandLu(std::size_t n, std::vector<Entry> entries);

  std::size_t size() const { return n_; }
  /// Overwrites b with A⁻¹ b, or A⁻ᵀ b. O(n · bandwidth). A singular matrix has its vanishing pivots replaced.
  void solve(double* b) const;
  void solve_transposed(double* b) const;
  /// Returns the smallest pivot relative to the largest entry: a sign of singularity that costs nothing.
  double pivot_ratio() const { return pivot_ratio_; }

  struct NullVectors {
    double smallest = 0;              ///< smallest singular value
    std::vector<double> left, right;  ///< singular vectors of `smallest`, unit length
  };
  /// Returns the smallest singular value and its vectors, by inverse iteration.
  NullVectors null_vectors(int iterations = 40) const;
  /// Returns the ratio of the largest to the smallest singular value, by power iteration, to a few percent.
  double condition() const;

 private:
  double* row(std::size_t i) { return &lu_[i * width_]; }  // column j at [j + lower_ − i]
  const double* row(std::size_t i) const { return &lu_[i * width_]; }
  double largest_singular_value() const;
  std::size_t n_, lower_ = 0, width_ = 1;
  std::vector<double> lu_, multipliers_;
  std::vector<std::size_t> exchanged_;
  std::vector<Entry> entries_;
  double pivot_ratio_ = 0;
};

}  // namespace bahnwerk::cam
