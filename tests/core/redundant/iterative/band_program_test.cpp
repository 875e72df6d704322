#include "core/redundant/iterative/band_program.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

VariableRow row(std::size_t first, std::initializer_list<double> weights) {
  VariableRow r;
  r.first = first;
  for (const double w : weights) r.weights[r.count++] = w;
  return r;
}
SymmetricBand<> unit(std::size_t n) {
  SymmetricBand<> m(n, 2);
  for (std::size_t i = 0; i < n; ++i) m.at(i, i) = 1;
  return m;
}

TEST(BandProgram, FindsTheNearestPointOfABox) {
  BandProgram p{unit(3), {}, {-2, 0.5, 0.2}, 0};  // nearest to (2, −0.5, −0.2)
  for (std::size_t i = 0; i < 3; ++i) p.rows.push_back({row(i, {1}), -0.3, 1, 0});
  const BandSolution s = solve(p, {0, 0, 0}, {});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.y[0], 1, 1e-4);
  EXPECT_NEAR(s.y[1], -0.3, 1e-4);
  EXPECT_NEAR(s.y[2], -0.2, 1e-4);
}

TEST(BandProgram, LeastLargestDeviationAlternates) {
  // A constant against 0, 1, 4: in the middle of the extremes.
  BandProgram p{SymmetricBand<>(1, 2), {}, {}, 1};
  for (const double x : {0.0, 1.0, 4.0}) p.rows.push_back({row(0, {1}), x, x, 1});
  const BandSolution s = solve(p, {0}, {});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.y[0], 2, 1e-4);
  EXPECT_NEAR(s.w, 2, 1e-4);
}

TEST(BandProgram, ElasticRowsGiveWayNoFurtherThanTheyHaveTo) {
  // y in [1, 2] is hard, |y| ≤ 0.5 elastic in units of 0.5: w = 1.
  BandProgram p{unit(1), {}, {}, 1e3};
  p.rows.push_back({row(0, {1}), 1, 2, 0});
  p.rows.push_back({row(0, {1}), -0.5, 0.5, 0.5});
  const BandSolution s = solve(p, {5}, {});
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.y[0], 1, 1e-5);
  EXPECT_NEAR(s.w, 1, 1e-4);
  p.rows[1].upper = 1.5;  // now they need not
  EXPECT_NEAR(solve(p, {5}, {}).w, 0, 1e-5);
}

/// At the optimum of a convex program no feasible direction descends.
TEST(BandProgram, NothingNearIsBetter) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const std::size_t n = 12;
    BandProgram p{SymmetricBand<>(n, 3), {}, {}, 0};
    for (std::size_t i = 0; i + 4 <= n; ++i) {
      const double square[] = {random.uniform(-1, 1), 1, random.uniform(-1, 1), 0.3};
      p.quadratic.add(i, 4, square, 1);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double x = random.uniform(-2, 2);
      p.rows.push_back({row(i, {1}), x - 0.5, x + 0.5, 0});
      p.linear.push_back(random.uniform(-1, 1));
    }
    const BandSolution s = solve(p, std::vector<double>(n, 0.0), {});
    ASSERT_TRUE(s.converged);
    const auto value = [&](const std::vector<double>& y) {
      std::vector<double> q(n, 0.0);
      p.quadratic.multiply(y, q);
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += (0.5 * q[i] + p.linear[i]) * y[i];
      return sum;
    };
    const double best = value(s.y);
    for (int k = 0; k < 200; ++k) {
      std::vector<double> y = s.y;
      for (std::size_t i = 0; i < n; ++i)
        y[i] = std::clamp(y[i] + random.uniform(-0.1, 0.1), p.rows[i].lower, p.rows[i].upper);
      EXPECT_GE(value(y), best - 1e-4 * (1 + std::abs(best)));
    }
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_GE(s.y[i], p.rows[i].lower - 1e-8);
      EXPECT_LE(s.y[i], p.rows[i].upper + 1e-8);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
