#include "core/numeric/linear/block_tridiagonal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// A = BᵀB + I of random blocks, and the same matrix in full.
template <int N>
Eigen::MatrixXd fill(BlockTridiagonal<N>& matrix, Random& random) {
  const auto nodes = static_cast<Eigen::Index>(matrix.nodes());
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(N * nodes, N * nodes);
  for (Eigen::Index n = 0; n < nodes; ++n)
    for (Eigen::Index i = 0; i < N; ++i)
      for (Eigen::Index j = 0; j < (n + 1 < nodes ? 2 * N : N); ++j) b(N * n + i, N * n + j) = random.uniform(-1, 1);
  const Eigen::MatrixXd full = b.transpose() * b + Eigen::MatrixXd::Identity(N * nodes, N * nodes);
  for (Eigen::Index n = 0; n < nodes; ++n) {
    matrix.diagonal(static_cast<std::size_t>(n)) = full.block<N, N>(N * n, N * n);
    if (n + 1 < nodes) matrix.above(static_cast<std::size_t>(n)) = full.block<N, N>(N * n, N * (n + 1));
  }
  return full;
}

template <int N>
void solves_what_the_full_matrix_says(std::size_t nodes) {
  Random random(3);
  BlockTridiagonal<N> matrix(nodes);
  const Eigen::MatrixXd full = fill(matrix, random);
  typename BlockTridiagonal<N>::Vectors x(nodes);
  Eigen::VectorXd right(full.rows());
  for (std::size_t n = 0; n < nodes; ++n)
    for (int i = 0; i < N; ++i) x[n](i) = right(static_cast<Eigen::Index>(n) * N + i) = random.uniform(-1, 1);
  ASSERT_TRUE(matrix.factor());
  ASSERT_TRUE(matrix.solve(x));
  const Eigen::VectorXd expected = full.ldlt().solve(right);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int i = 0; i < N; ++i) EXPECT_NEAR(x[n](i), expected(static_cast<Eigen::Index>(n) * N + i), 1e-10);
}

TEST(BlockTridiagonal, SolvesSystemsOfAnyNumberOfNodes) {
  solves_what_the_full_matrix_says<4>(1);
  solves_what_the_full_matrix_says<8>(2);
  solves_what_the_full_matrix_says<12>(30);
}

TEST(BlockTridiagonal, MatricesThatAreNotPositiveDefiniteHaveNoFactors) {
  Random random(5);
  BlockTridiagonal<4> matrix(6);
  fill(matrix, random);
  matrix.diagonal(4)(2, 2) = -1;
  EXPECT_FALSE(matrix.factor());
  matrix.clear();
  EXPECT_FALSE(matrix.factor());
}

}  // namespace
}  // namespace bahnwerk
