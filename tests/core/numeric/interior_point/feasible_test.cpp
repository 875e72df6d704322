#include "core/numeric/interior_point/feasible.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

/// minimise 3 + x + 2 y so that x² + y² ≤ 1 and x ≥ −a.
struct Disc final : FeasibleProblem {
  double x = 0.1, y = 0.2, left = 2;
  double dx = 0, dy = 0, to_x = 0, to_y = 0;
  bool may_step = true;

  double objective() const override { return 3 + x + 2 * y; }
  bool slacks_at(double at_x, double at_y, std::vector<double>& slack) const {
    slack = {1 - at_x * at_x - at_y * at_y, at_x + left};
    return slack[0] > 0 && slack[1] > 0;
  }
  bool slacks(std::vector<double>& slack) const override { return slacks_at(x, y, slack); }
  bool step(const BarrierPoint& at) override {
    const double round = 2 * at.multiplier[0], steep = at.multiplier[0] / at.slack[0],
                 wall = at.multiplier[1] / at.slack[1];
    const double xx = (round + steep * 4 * x * x + wall) * (1 + at.damping), xy = steep * 4 * x * y,
                 yy = (round + steep * 4 * y * y) * (1 + at.damping);
    const double gx = 1 + at.mu / at.slack[0] * 2 * x - at.mu / at.slack[1], gy = 2 + at.mu / at.slack[0] * 2 * y;
    const double determinant = xx * yy - xy * xy;
    dx = -(yy * gx - xy * gy) / determinant, dy = -(xx * gy - xy * gx) / determinant;
    return may_step && determinant > 0;
  }
  double changes(std::vector<double>& change) const override {
    change = {-2 * (x * dx + y * dy), dx};
    return dx + 2 * dy;
  }
  bool go(double length, std::size_t, std::vector<double>& slack, double& objective) override {
    to_x = x + length * dx, to_y = y + length * dy;
    objective = 3 + to_x + 2 * to_y;
    return slacks_at(to_x, to_y, slack);
  }
  void accept() override { x = to_x, y = to_y; }
};

TEST(Feasible, FindsTheMinimumInsideOfEveryConstraint) {
  Disc disc;
  const FeasibleResult result = solve_feasible(disc, {.gap = 1e-9, .iterations = 60});
  EXPECT_LE(result.gap, 1e-9);
  EXPECT_LT(result.iterations, 40);
  EXPECT_NEAR(disc.objective(), 3 - std::sqrt(5), 1e-7);
  std::vector<double> slack;
  EXPECT_TRUE(disc.slacks(slack));

  Disc walled;
  walled.left = 0.25;
  solve_feasible(walled, {.gap = 1e-9, .iterations = 60});
  EXPECT_NEAR(walled.x, -0.25, 1e-6);
  EXPECT_NEAR(walled.y, -std::sqrt(1 - 0.0625), 1e-6);
}

TEST(Feasible, AStartThatBreaksAConstraintStays) {
  Disc disc;
  disc.x = 2;
  EXPECT_EQ(solve_feasible(disc, {}).iterations, 0);
  EXPECT_EQ(disc.x, 2);
}

TEST(Feasible, EveryIterateIsFeasibleAndNoWorseWhereverTheRunEnds) {
  double before = Disc().objective();
  for (int iterations = 1; iterations < 12; ++iterations) {
    Disc disc;
    solve_feasible(disc, {.gap = 1e-9, .iterations = iterations});
    std::vector<double> slack;
    EXPECT_TRUE(disc.slacks(slack)) << iterations;
    if (iterations > 3) {
      EXPECT_LE(disc.objective(), before) << iterations;
    }
    before = disc.objective();
  }
}

TEST(Feasible, WithoutAnyStepTheIterateStaysAndTheRunEnds) {
  Disc disc;
  disc.may_step = false;
  int ticks = 0;
  EXPECT_EQ(solve_feasible(disc, {.iterations = 7, .tick = [&] { ++ticks; }}).iterations, 7);
  EXPECT_EQ(disc.x, 0.1);
  EXPECT_EQ(ticks, 7);
}

}  // namespace
}  // namespace bahnwerk
