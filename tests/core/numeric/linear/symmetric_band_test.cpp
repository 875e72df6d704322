#include "core/numeric/linear/symmetric_band.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t width = 4;

template <class Band>
void expect_solutions(const Band& zero, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const std::size_t n = zero.size(), diagonals = zero.width();
  Band given = zero;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < std::min(n, j + diagonals + 1); ++i)
      given.at(i, j) = i == j ? 5 + any(random) : any(random) / 2;
  Band factored = given;
  std::vector<double> right(n);
  for (double& r : right) r = any(random);
  std::vector<double> x = right;
  EXPECT_TRUE(factored.factor());
  factored.solve(x);
  ASSERT_EQ(x.size(), n);
  std::vector<double> product(n, 0.0);
  given.multiply(x, product);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = i > diagonals ? i - diagonals : 0; j < std::min(n, i + diagonals + 1); ++j)
      sum += (j <= i ? given.at(i, j) : given.at(j, i)) * x[j];
    EXPECT_NEAR(sum, right[i], 1e-13) << n << ' ' << i;
    EXPECT_NEAR(product[i], sum, 1e-14) << n << ' ' << i;
  }
}

TEST(SymmetricBand, SolutionsSatisfyTheirEquations) {
  std::mt19937 random(6);
  for (const std::size_t n : {1u, 3u, 5u, 60u}) {
    expect_solutions(SymmetricBand<width>(n), random);
    for (std::size_t at_run_time = 0; at_run_time <= 6; ++at_run_time)
      expect_solutions(SymmetricBand<>(n, at_run_time), random);
  }
}

TEST(SymmetricBand, SolvesWhatRowsMake) {
  Random random(1);
  for (const std::size_t n : {1u, 2u, 5u, 40u}) {
    const std::size_t count = std::min<std::size_t>(4, n);
    SymmetricBand<> a(n, 3), twice(n, 3);
    std::vector<double> x(n), b(n, 0.0), row(count);
    for (double& v : x) v = random.uniform(-1, 1);
    for (int i = 0; i < 200; ++i) {
      const std::size_t first = random.below(n - count + 1);
      for (double& v : row) v = random.uniform(-1, 1);
      const double weight = random.uniform(0.1, 1);
      a.add(first, count, row.data(), weight);
      double product = 0;
      for (std::size_t r = 0; r < count; ++r) product += row[r] * x[first + r];
      for (std::size_t r = 0; r < count; ++r) b[first + r] += weight * product * row[r];
    }
    twice.add(a, 2);
    for (SymmetricBand<>* matrix : {&a, &twice}) {
      std::vector<double> solution = b;
      ASSERT_TRUE(matrix->factor());
      matrix->solve(solution);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(solution[i], matrix == &a ? x[i] : x[i] / 2, 1e-11);
    }
  }
}

TEST(SymmetricBand, KnowsWhenItIsSingular) {
  SymmetricBand<> a(3, 1);
  const double difference[] = {1, -1};
  a.add(0, 2, difference, 1);
  a.add(1, 2, difference, 1);  // only differences
  EXPECT_FALSE(a.factor());
}

TEST(SymmetricBand, AnUnknownWithoutEquationStaysUnchanged) {
  SymmetricBand<width> matrix(3);
  matrix.at(0, 0) = 2, matrix.at(1, 1) = 0, matrix.at(2, 2) = 4;
  EXPECT_FALSE(matrix.factor());
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
