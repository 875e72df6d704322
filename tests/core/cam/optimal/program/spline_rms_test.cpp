// The second objective of an optimal law.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/cam/optimal/optimal_law.hpp"
#include "tests/core/cam/problems.hpp"

namespace bahnwerk::cam {
namespace {

using namespace testing_problems;

/// A rise of 30 in 60, a dwell, and a return in 200: the rise has the peaks.
MotionLawProblem fast_rise() {
  MotionLawProblem out = problem(300, false, {rest(0, 0), rest(60, 30), rest(100, 30), rest(300, 0)});
  out.points[0].section[1].min = 0;
  out.points[1].law = ClassicalLaw::straight;
  out.points[2].section[1].max = 0;
  out.method = LawMethod::optimal;
  out.degree = 5;
  out.pieces = 4;
  return out;
}
LawSolution planned(MotionLawProblem problem, int then) {
  Progress progress;
  problem.objective.then_order = then;
  return plan_optimal_law(problem, progress).solution;
}

TEST(SplineRms, ASlowReturnBesideAFastRiseIsThePolynomialOfLeastJerk) {
  const LawSolution law = planned(fast_rise(), 3);
  // Between states of position, velocity and acceleration ∫ j² is least for the polynomial of degree 5.
  EXPECT_NEAR(law.law.section_rms(3, 2), 30 / 8e6 * std::sqrt(720), 1e-6 * 1e-4);
  for (double x = 0; x <= 1; x += 0.05)
    EXPECT_NEAR(law.law.evaluate(100 + 200 * x, 0), 30 * (1 - x * x * x * (10 - 15 * x + 6 * x * x)), 1e-3);
}

TEST(SplineRms, TheReturnHasNoMoreAccelerationThanItsOwnOptimum) {
  const LawSolution both = planned(fast_rise(), 2);
  MotionLawProblem alone = fast_rise();
  alone.points.erase(alone.points.begin(), alone.points.begin() + 2);
  alone.length = 200;
  alone.cycle_duration = 200;
  const LawSolution own = planned(alone, 0);
  EXPECT_LE(both.law.section_rms(2, 2), own.law.rms(2) * (1 + 1e-6));
}

TEST(SplineRms, JStaysTheLeastAndTheMeanSquareFalls) {
  const LawSolution first = planned(fast_rise(), 0);
  for (const int order : {2, 3}) {
    const LawSolution second = planned(fast_rise(), order);
    EXPECT_LE(second.value.objective, first.value.objective * (1 + 4e-9));
    EXPECT_LT(second.law.rms(order), first.law.rms(order));
  }
}

TEST(SplineRms, RangesAndLimitsHoldAsInTheFirstLaw) {
  MotionLawProblem problem = fast_rise();
  problem.points[2].section[1].min = -0.22;
  problem.points.insert(problem.points.begin() + 3, point(180, 2, {{20, 22}}));
  problem.points[3].section[1].max = 0;
  const LawSolution law = planned(problem, 2);
  const LawExtremes velocity = law.law.section_extremes(1, 2);
  EXPECT_GE(velocity.lowest.value, -0.22 * (1 + 1e-9));
  EXPECT_LE(velocity.highest.value, 1e-9);
  EXPECT_GE(law.law.evaluate(180, 0), 20 - 1e-9);
  EXPECT_LE(law.law.evaluate(180, 0), 22 + 1e-9);
}

}  // namespace
}  // namespace bahnwerk::cam
