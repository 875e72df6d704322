#include "core/numeric/linear/symmetric_band.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace bahnwerk {
namespace {

constexpr std::size_t width = 4;

TEST(SymmetricBand, SolutionsSatisfyTheirEquations) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const std::size_t n : {1u, 3u, 5u, 60u}) {
    SymmetricBand<width> given(n), factored(n);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = j; i < std::min(n, j + width + 1); ++i)
        given.at(i, j) = factored.at(i, j) = i == j ? 5 + any(random) : any(random) / 2;
    std::vector<double> right(n);
    for (double& r : right) r = any(random);
    std::vector<double> x = right;
    factored.factor([] {});
    factored.solve(x);
    ASSERT_EQ(x.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t j = i > width ? i - width : 0; j < std::min(n, i + width + 1); ++j)
        sum += (j <= i ? given.at(i, j) : given.at(j, i)) * x[j];
      EXPECT_NEAR(sum, right[i], 1e-13) << n << ' ' << i;
    }
  }
}

TEST(SymmetricBand, AnUnknownWithoutEquationStaysUnchanged) {
  SymmetricBand<width> matrix(3);
  matrix.at(0, 0) = 2, matrix.at(1, 1) = 0, matrix.at(2, 2) = 4;
  matrix.factor([] {});
  std::vector<double> x{2, 0, 8};
  matrix.solve(x);
  EXPECT_NEAR(x[0], 1, 1e-15);
  EXPECT_NEAR(x[1], 0, 1e-15);
  EXPECT_NEAR(x[2], 2, 1e-15);
}

TEST(SymmetricBand, ResetLeavesZeros) {
  SymmetricBand<width> matrix(6);
  matrix.at(5, 2) = 3;
  matrix.reset(6);
  for (std::size_t j = 0; j < 6; ++j)
    for (std::size_t i = j; i < std::min<std::size_t>(6, j + width + 1); ++i) EXPECT_EQ(matrix.at(i, j), 0);
}

}  // namespace
}  // namespace bahnwerk
