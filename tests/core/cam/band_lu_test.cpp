#include "core/cam/spline/band_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "tests/core/cases.hpp"

namespace bahnwerk::cam {
namespace {

struct Band {
  std::vector<BandLu::Entry> entries;
  Eigen::MatrixXd dense;
};
Band random_band(std::mt19937& random, std::size_t n) {
  std::uniform_real_distribution<double> value(-1, 1);
  Band out{{}, Eigen::MatrixXd::Zero(static_cast<int>(n), static_cast<int>(n))};
  const std::size_t lower = random() % 4, upper = random() % 5;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i > lower ? i - lower : 0; j < std::min(n, i + upper + 1); ++j) {
      out.entries.push_back({i, j, value(random) + (i == j ? 0.3 : 0)});
      out.dense(static_cast<int>(i), static_cast<int>(j)) = out.entries.back().value;
    }
  return out;
}

TEST(BandLu, SolvesBothWaysAndKnowsItsCondition) {
  std::mt19937 random(2);
  for (int i = 0; i < testing::cases(100); ++i) {
    const std::size_t n = 1 + random() % 30;
    const Band band = random_band(random, n);
    const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(band.dense).singularValues();
    const double condition = singular(0) / singular(static_cast<int>(n) - 1);
    if (condition > 1e6) continue;
    const BandLu lu(n, band.entries);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(static_cast<int>(n), 1, 2);
    Eigen::VectorXd b = band.dense * x, c = band.dense.transpose() * x;
    lu.solve(b.data());
    lu.solve_transposed(c.data());
    EXPECT_LT((b - x).norm(), 1e-9 * condition * 1e-3 + 1e-12) << i;
    EXPECT_LT((c - x).norm(), 1e-9 * condition * 1e-3 + 1e-12) << i;
    EXPECT_NEAR(lu.condition() / condition, 1, 0.06) << i;
  }
}

TEST(BandLu, NullVectorsOfASingularMatrix) {
  // The second difference around a cycle of four, one row for each: constants are its null vectors.
  std::vector<BandLu::Entry> entries;
  for (std::size_t i = 0; i < 4; ++i) {
    entries.push_back({i, i, 1});
    entries.push_back({i, (i + 1) % 4, -0.5});
    entries.push_back({i, (i + 3) % 4, -0.5});
  }
  const BandLu lu(4, entries);
  EXPECT_LT(lu.pivot_ratio(), 1e-15);
  const auto null = lu.null_vectors();
  EXPECT_LT(null.smallest, 1e-14);
  for (const double x : null.right) EXPECT_NEAR(std::abs(x), 0.5, 1e-12);
  for (const double y : null.left) EXPECT_NEAR(std::abs(y), 0.5, 1e-12);
}

}  // namespace
}  // namespace bahnwerk::cam
