// The convex problem against closed forms, and by what holds of every convex problem: weak duality, relaxations only
// lower.
#include "core/motion/relaxation/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "tests/core/motion/relaxation/problems.hpp"

namespace bahnwerk {
namespace {

using test::circle;
using test::line;

constexpr double infinite = std::numeric_limits<double>::infinity();

double solved(const RelaxationProblem<2>& problem) {
  Progress silent;
  ProgressScope progress(silent, "test");
  RelaxationSolver<2> solver;
  const RelaxationOutcome outcome = solver.solve(problem, {}, progress);
  EXPECT_TRUE(outcome.converged);
  return outcome.duration;
}

double double_s(double way, double velocity, double acceleration, double jerk) {
  const double ramp = acceleration / jerk;
  const double change =
      velocity >= acceleration * ramp ? velocity / acceleration + ramp : 2 * std::sqrt(velocity / jerk);
  if (way >= velocity * change) return way / velocity + change;
  if (way >= 2 * acceleration * ramp * ramp) return ramp + std::sqrt(ramp * ramp + 4 * way / acceleration);
  return std::cbrt(32 * way / jerk);
}

TEST(Relaxation, LinesReachTheClosedFormFromBelow) {
  struct Case {
    double way, velocity, acceleration, jerk;
  };
  for (const Case& c : {Case{100, 1800, 16000, 1e6}, Case{100, 300, 16000, 1e6}, Case{5, 1800, 16000, 1e5},
                        Case{1000, 500, 2000, 3e4}, Case{0.01, 1800, 16000, 1e6}}) {
    const double exact = double_s(c.way, c.velocity, c.acceleration, c.jerk);
    const double coarse = solved(line(c.way, 60, c.velocity, c.acceleration, c.jerk)),
                 fine = solved(line(c.way, 400, c.velocity, c.acceleration, c.jerk));
    EXPECT_LE(coarse, exact * (1 + 1e-5));
    EXPECT_LE(fine, exact * (1 + 1e-5));
    EXPECT_GE(fine, exact * (1 - 1e-3));
    EXPECT_GE(coarse, exact * (1 - 1e-2));
  }
}

TEST(Relaxation, CirclesWithFreeEndsGoAtTheSpeedThatJerkAllows) {
  // All around at constant speed: v³/r² = J would be exceeded nowhere; a little faster is possible between the axes'
  // worst places, so the circle at that speed is feasible and no faster than the optimum.
  const double r = 10, jerk = 1e5, speed = std::cbrt(jerk * r * r);
  RelaxationProblem<2> p = circle(r, 400, 1e4, 1e9, jerk);
  p.rest_first = p.rest_last = false;
  const double steady = 2 * std::numbers::pi * r / speed, found = solved(p);
  EXPECT_LE(found, steady);
  EXPECT_GE(found, 0.7 * steady);
}

TEST(Relaxation, LooserLimitsAreNotSlower) {
  const auto base = circle(10, 200, 1800, 16000, 1e6);
  const double before = solved(base);
  for (int change = 0; change < 6; ++change) {
    auto looser = base;
    if (change == 0) looser.jerk[0] *= 3;
    if (change == 1) looser.jerk = {infinite, infinite};
    if (change == 2) looser.acceleration[1] *= 2;
    if (change == 3) looser.rest_last = false;
    if (change == 4) looser.rest_first = looser.rest_last = false;
    if (change == 5) looser.steps.push_back({100, 0, {1e-3, 1e-3}, {}});
    EXPECT_LE(solved(looser), before * (1 + 2e-5)) << change;
  }
}

// Lagrange: for the multipliers found, the least of Σ T_j + multipliers · violated limits over all b and T is the
// duration again; for any others it is less.
TEST(Relaxation, MultipliersAreFeasibleAndTheirDualIsTheOptimum) {
  const auto p = circle(10, 150, 400, 16000, 1e6);
  Progress silent;
  ProgressScope progress(silent, "test");
  RelaxationSolver<2> solver;
  RelaxationOptions options;
  options.gap = 1e-8;
  const double optimum = solver.solve(p, options, progress).duration;
  const RelaxationMultipliers<2> m = solver.multipliers();
  ASSERT_EQ(m.jerk.size(), p.cells.size() + 2);
  ASSERT_EQ(m.acceleration.size(), p.cells.size() + 1);
  const double dual = test::dual_of(p, m);
  for (const auto& l : m.jerk) EXPECT_LE(p.jerk[0] * std::abs(l[0]) + p.jerk[1] * std::abs(l[1]), 1 + 1e-12);
  EXPECT_LE(dual, optimum * (1 + 1e-6));
  EXPECT_GE(dual, optimum * (1 - 1e-5));
}

TEST(Relaxation, OneCellAndMemoryOfAnotherProblem) {
  Progress silent;
  ProgressScope progress(silent, "test");
  RelaxationSolver<2> solver;
  const auto large = circle(10, 300, 1800, 16000, 1e6), small = line(1, 1, 1800, 16000, 1e6);
  const double first = solver.solve(large, {}, progress).duration;
  EXPECT_GT(solver.solve(small, {}, progress).duration, 0);
  EXPECT_EQ(solver.solve(large, {}, progress).duration, first);
  EXPECT_EQ(solver.b().size(), 300u);
}

}  // namespace
}  // namespace bahnwerk
