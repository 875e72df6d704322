#include "core/verify/probe/edge_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"
#include "core/probe/problem.hpp"
#include "core/verify/probe/edge_times.hpp"

namespace bahnwerk {
namespace {

// From rest to rest over `length` along x, on a grid that is finer at the ends.
EdgeBoundProblem<2> rest_to_rest(double length, double speed) {
  EdgeBoundProblem<2> p;
  p.speed = speed;
  p.derivative = {{{200, 200}, {4000, 4000}, {200000, 200000}}};
  const SampleSet<2> begin{{0, 0}, {0, 0}, 1e-9}, end{{length, 0}, {length, 0}, 1e-9}, edge{{0, 0}, {length, 0}, 0.05};
  const int n = 60;
  for (int i = -4; i <= n + 4; ++i) {
    p.grid.push_back(static_cast<double>(i) / n);
    p.set.push_back(i <= 0 ? begin : i >= n ? end : edge);
    p.set.back().with_last = (i > -4 && i <= 0) || i > n;
  }
  return p;
}

TEST(EdgeBound, DifferencesOfPolynomialsAreTheirDerivatives) {
  const std::vector<double> grid = {0, 0.1, 0.15, 0.4, 0.5, 0.9};
  const auto rows = difference_rows(grid);
  double factorial = 1;
  for (std::size_t r = 1; r <= 4; ++r) {
    factorial *= static_cast<double>(r);
    for (std::size_t k = 0; k < rows[r - 1].size(); ++k) {
      double power = 0, lower = 0;
      for (std::size_t i = 0; i <= r; ++i) {
        power += rows[r - 1][k][i] * std::pow(grid[k + i], static_cast<double>(r));
        lower += rows[r - 1][k][i] * std::pow(grid[k + i], static_cast<double>(r) - 1);
      }
      EXPECT_NEAR(power, factorial, 1e-9);
      EXPECT_NEAR(lower, 0, 1e-9);
    }
  }
}

TEST(EdgeBound, RestToRestComesNearTheLeastTimeFromBelow) {
  const double length = 0.04, least = std::pow(384 * length / 200000, 0.25);
  const EdgeBoundProblem<2> p = rest_to_rest(length, 20);
  const double found = certified_time<2>(p, edge_multipliers<2>(p, 60));
  EXPECT_LE(found, least);
  // Even samples lose a step or two at either rest.
  EXPECT_GT(found, 0.94 * least);
}

// What makes it a bound: whatever the multipliers are, none proves more than the time of a motion that exists.
TEST(EdgeBound, NoMultipliersProveMoreThanAMotionTakes) {
  const double length = 0.04, exists = std::pow(384 * length / 200000, 0.25);
  const EdgeBoundProblem<2> p = rest_to_rest(length, 20);
  const EdgeMultipliers<2> best = edge_multipliers<2>(p, 60);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    EdgeMultipliers<2> y = best;
    const double size = std::pow(10, random.uniform(-6, 0));
    for (auto& order : y)
      for (auto& m : order)
        for (double& x : m) x *= 1 + size * random.uniform(-1, 1);
    EXPECT_LE(certified_time<2>(p, y), exists);
  }
}

TEST(EdgeBound, MultipliersThatAreNoNumbersProveNothing) {
  const EdgeBoundProblem<2> p = rest_to_rest(1, 20);
  EdgeMultipliers<2> y = edge_multipliers<2>(p, 60);
  y[2][5][0] = std::nan("");
  EXPECT_EQ(certified_time<2>(p, y), 0);
}

}  // namespace
}  // namespace bahnwerk
