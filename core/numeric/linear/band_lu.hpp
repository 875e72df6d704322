#pragma once
/// Square band matrices and their LU factors, by Gaussian elimination with partial pivoting (Golub & Van Loan, "Matrix
/// Computations", 4.3.5).
#include <cstddef>
#include <vector>

namespace bahnwerk {

class BandLu {
 public:
  /// Becomes the zero matrix of n rows with `lower` diagonals below the main one and `upper` above it; keeps its
  /// memory. Exchanged rows fill `lower` more diagonals: memory n (2 lower + upper + 1).
  void reset(std::size_t n, std::size_t lower, std::size_t upper);
  std::size_t size() const { return n_; }
  /// Returns entry (i, j), i − lower ≤ j ≤ i + upper. Entries of one row are contiguous.
  double& at(std::size_t i, std::size_t j) { return a_[i * width_ + (j + lower_ - i)]; }
  double at(std::size_t i, std::size_t j) const { return a_[i * width_ + (j + lower_ - i)]; }

  /// Factors in place, O(n lower (lower + upper)). A pivot of at most `least` times the largest entry becomes one of
  /// the size of rounding. Returns false for the zero matrix and where an entry is not a number.
  bool factor(double least = 0);
  /// Returns the smallest pivot relative to the largest entry: a sign of singularity that costs nothing.
  double pivot_ratio() const { return pivot_ratio_; }

  /// Replaces the n numbers x by A⁻¹ x, or by A⁻ᵀ x. To be called after factor(). O(n (lower + upper)).
  void solve(double* x) const;
  void solve_transposed(double* x) const;
  /// Replaces n rows of `columns` numbers by A⁻¹ times them: all right-hand sides at once.
  void solve(double* x, std::size_t columns) const;

 private:
  /// Returns the last row, or column, that elimination with pivot k changes.
  std::size_t last_row(std::size_t k) const { return k + lower_ < n_ ? k + lower_ : n_ - 1; }
  std::size_t last_column(std::size_t k) const { return k + lower_ + upper_ < n_ ? k + lower_ + upper_ : n_ - 1; }

  std::size_t n_ = 0, lower_ = 0, upper_ = 0, width_ = 1;
  std::vector<double> a_;            // row i begins with column i − lower
  std::vector<std::size_t> pivots_;  // the row that was exchanged with row k
  double pivot_ratio_ = 0;
};

}  // namespace bahnwerk
