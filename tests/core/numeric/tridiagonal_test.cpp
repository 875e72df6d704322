#include "core/numeric/tridiagonal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace bahnwerk {
namespace {

Tridiagonal random_dominant(std::size_t n, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  Tridiagonal matrix(n);
  for (std::size_t i = 0; i < n; ++i) {
    matrix.below[i] = any(random), matrix.above[i] = any(random);
    matrix.at[i] = (any(random) < 0 ? -1 : 1) * (1.1 * (std::abs(matrix.below[i]) + std::abs(matrix.above[i])) + 0.1);
  }
  return matrix;
}

/// Row i of the matrix times x.
double row(const Tridiagonal& m, std::size_t i, const std::vector<double>& x, bool periodic) {
  const std::size_t n = m.size();
  double sum = m.at[i] * x[i];
  if (i > 0 || periodic) sum += m.below[i] * x[i > 0 ? i - 1 : n - 1];
  if (i + 1 < n || periodic) sum += m.above[i] * x[i + 1 < n ? i + 1 : 0];
  return sum;
}

TEST(Tridiagonal, SolutionsSatisfyTheirEquations) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-5, 5);
  for (std::size_t n = 1; n <= 40; ++n)
    for (const bool periodic : {false, true}) {
      if (periodic && n < 3) continue;
      const Tridiagonal matrix = random_dominant(n, random);
      std::vector<double> right(n);
      for (double& r : right) r = any(random);
      std::vector<double> x = right;
      periodic ? matrix.solve_periodic(x) : matrix.solve(x);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(row(matrix, i, x, periodic), right[i], 1e-12) << n << ' ' << i;
    }
}

TEST(Tridiagonal, CornersDoNotCountInAnOpenSystem) {
  Tridiagonal matrix(3);
  matrix.at = {2, 3, 4}, matrix.below = {0, 1, 1}, matrix.above = {1, 1, 0};
  std::vector<double> x{3, 5, 5}, y = x;
  matrix.solve(x);
  matrix.below[0] = matrix.above[2] = 7;
  matrix.solve(y);
  EXPECT_EQ(x, y);
  EXPECT_NEAR(x[0], 1, 1e-15);  // the solution of these three equations is 1, 1, 1
  EXPECT_NEAR(x[2], 1, 1e-15);
}

}  // namespace
}  // namespace bahnwerk
