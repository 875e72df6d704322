#pragma once
/// Systems A x = b with a symmetric positive definite block tridiagonal matrix, by block Cholesky factors.
///
/// The elimination runs from the first node to the last one: D_n = A_nn − C_(n−1)ᵀ C_(n−1) = L_n L_nᵀ,
/// C_n = L_n⁻¹ A_(n,n+1). That is the Riccati recursion of a linear-quadratic problem whose stages are the nodes
/// (Golub & Van Loan, "Matrix Computations", 4.5). Factors take the place of the matrix. Cost: 7/3 N³ per node.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/StdVector>
#include <cstddef>
#include <vector>

namespace bahnwerk {

template <int N>
class BlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  using Blocks = std::vector<Block, Eigen::aligned_allocator<Block>>;
  using Vectors = std::vector<Vector, Eigen::aligned_allocator<Vector>>;

  explicit BlockTridiagonal(std::size_t nodes) : diagonal_(nodes), above_(nodes - 1) {}

  std::size_t nodes() const { return diagonal_.size(); }
  /// Sets the matrix to 0.
  void clear() {
    for (Block& block : diagonal_) block.setZero();
    for (Block& block : above_) block.setZero();
  }
  Block& diagonal(std::size_t n) { return diagonal_[n]; }  ///< A_nn, of which the lower triangle counts
  Block& above(std::size_t n) { return above_[n]; }        ///< A_(n,n+1)

  /// Factors the matrix; returns whether it is positive definite.
  bool factor() {
    for (std::size_t n = 0; n < nodes(); ++n) {
      if (n > 0) diagonal_[n].noalias() -= above_[n - 1].transpose() * above_[n - 1];
      const Eigen::LLT<Eigen::Ref<Block>> factor(diagonal_[n]);
      if (factor.info() != Eigen::Success) return false;
      if (n + 1 < nodes()) lower(n).solveInPlace(above_[n]);
    }
    return true;
  }
  /// Computes x := A⁻¹ x; returns whether all of it is finite.
  bool solve(Vectors& x) const {
    for (std::size_t n = 0; n < nodes(); ++n) {
      if (n > 0) x[n].noalias() -= above_[n - 1].transpose() * x[n - 1];
      lower(n).solveInPlace(x[n]);
    }
    for (std::size_t n = nodes(); n-- > 0;) {
      if (n + 1 < nodes()) x[n].noalias() -= above_[n] * x[n + 1];
      diagonal_[n].transpose().template triangularView<Eigen::Upper>().solveInPlace(x[n]);
      if (!x[n].allFinite()) return false;
    }
    return true;
  }

 private:
  auto lower(std::size_t n) const { return diagonal_[n].template triangularView<Eigen::Lower>(); }

  Blocks diagonal_, above_;
};

}  // namespace bahnwerk
