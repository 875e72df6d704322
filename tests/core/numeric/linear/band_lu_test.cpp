#include "core/numeric/linear/band_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// A random matrix with small entries on its diagonal, so that rows are exchanged, and the same matrix in full.
Eigen::MatrixXd fill(BandLu& matrix, std::size_t n, std::size_t lower, std::size_t upper, Random& random) {
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(size, size);
  matrix.reset(n, lower, upper);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i > lower ? i - lower : 0; j < std::min(n, i + upper + 1); ++j)
      full(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = matrix.at(i, j) =
          random.uniform(-1, 1) * (i == j && lower > 0 && upper > 0 ? 1e-3 : 1);
  return full;
}

TEST(BandLu, SolvesWhatTheFullMatrixSays) {
  Random random(8);
  BandLu matrix;
  for (const std::size_t n : {1u, 2u, 7u, 40u})
    for (const auto& [lower, upper] : {std::pair<std::size_t, std::size_t>{1, 1}, {3, 3}, {2, 5}, {4, 1}, {0, 2}}) {
      const Eigen::MatrixXd full = fill(matrix, n, lower, upper, random);
      const Eigen::FullPivLU<Eigen::MatrixXd> reference(full);
      ASSERT_TRUE(matrix.factor());
      constexpr Eigen::Index columns = 3;
      const auto size = static_cast<Eigen::Index>(n);
      Eigen::Matrix<double, Eigen::Dynamic, columns, Eigen::RowMajor> right(size, columns);
      for (double& value : right.reshaped()) value = random.uniform(-1, 1);
      const Eigen::MatrixXd expected = reference.solve(right);
      const double tolerance = 1e-13 / reference.rcond();
      Eigen::VectorXd x = right.col(0), transposed = right.col(0);
      matrix.solve(x.data());
      EXPECT_LT((x - expected.col(0)).norm(), tolerance * (1 + x.norm())) << n << ' ' << lower << ' ' << upper;
      matrix.solve_transposed(transposed.data());
      EXPECT_LT((full.transpose() * transposed - right.col(0)).norm(), tolerance * (1 + transposed.norm())) << n;
      matrix.solve(right.data(), columns);
      EXPECT_LT((right - expected).norm(), tolerance * (1 + expected.norm())) << n << ' ' << lower << ' ' << upper;
    }
}

TEST(BandLu, PivotRatioTellsASingularMatrix) {
  BandLu matrix;
  matrix.reset(3, 1, 1);
  EXPECT_FALSE(matrix.factor()) << "the zero matrix";
  matrix.reset(3, 1, 1);
  matrix.at(0, 0) = 1, matrix.at(0, 1) = 1, matrix.at(1, 0) = 1, matrix.at(1, 1) = 1, matrix.at(2, 2) = 2;
  ASSERT_TRUE(matrix.factor(1e-16));
  EXPECT_EQ(matrix.pivot_ratio(), 0);
  std::vector<double> x{1, 0, 2};
  matrix.solve(x.data());
  EXPECT_GT(std::abs(x[0]), 1e15) << "the pivot that vanishes has the size of rounding";
  EXPECT_NEAR(x[0] + x[1], 1, 1);
  EXPECT_EQ(x[2], 1);
}

TEST(BandLu, EntriesThatAreNoNumbersHaveNoFactors) {
  BandLu matrix;
  matrix.reset(2, 1, 1);
  matrix.at(0, 0) = 1, matrix.at(1, 1) = std::nan("");
  EXPECT_FALSE(matrix.factor());
}

}  // namespace
}  // namespace bahnwerk
