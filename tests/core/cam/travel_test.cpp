// Laws that move on by a travel in each cycle.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/active_set/active_set.hpp"
#include "core/cam/optimal/drive.hpp"
#include "core/cam/optimal/optimal_law.hpp"
#include "tests/core/cam/problems.hpp"

namespace bahnwerk::cam {
namespace {

using namespace testing_problems;

/// Two strokes of 25 and 35 in a cycle of 100, as an open law and as one that moves on by 60.
MotionLawProblem strokes(bool periodic) {
  MotionLawProblem out =
      problem(100, periodic, {rest(0, 3), point(40, 2, {number(28), {-1, 0.2}}), point(70, 3, {{40, 50}})});
  out.points[1].section[1] = {0, 1.5};
  if (periodic)
    out.travel = 60;
  else
    out.points.push_back(rest(100, 63));
  out.method = LawMethod::optimal;
  out.degree = 6;
  out.pieces = 2;
  return out;
}

TEST(Travel, ALawThatRestsWhereTheCycleClosesIsTheOpenOne) {
  Progress progress;
  const OptimalLaw open = plan_optimal_law(strokes(false), progress),
                   onward = plan_optimal_law(strokes(true), progress);
  EXPECT_NEAR(onward.solution.value.objective, open.solution.value.objective, 1e-7 * open.solution.value.objective);
  EXPECT_NEAR(onward.solution.bound->objective, open.solution.bound->objective, 1e-4 * open.solution.value.objective);
  for (double t = 0; t < 100; t += 1)
    EXPECT_NEAR(onward.solution.law.evaluate(t, 0), open.solution.law.evaluate(t, 0), 1e-3);
}

TEST(Travel, ActiveSetPlansTheOpenLawWhereItRests) {
  Progress progress;
  MotionLawProblem open = strokes(false), onward = strokes(true);
  open.points[1].section[1] = onward.points[1].section[1] = {};
  const LawSolution a = *solve_active_set(open, angles(open), progress);
  const LawSolution b = *solve_active_set(onward, angles(onward), progress);
  EXPECT_NEAR(b.value.objective, a.value.objective, 1e-9 * a.value.objective);
  for (double t = 0; t < 100; t += 1) EXPECT_NEAR(b.law.evaluate(t, 0), a.law.evaluate(t, 0), 1e-9);
}

TEST(Travel, AnotherFirstPointChangesNothing) {
  Progress progress;
  MotionLawProblem one =
      problem(100, true, {point(10, 2, {number(0)}), point(45, 3, {number(30)}), point(80, 2, {number(35)})});
  one.travel = 50;
  one.degree = 5, one.pieces = 3;
  one.method = LawMethod::optimal;
  one.points[2].section[0] = {34, 51};
  MotionLawProblem other = one;
  std::rotate(other.points.begin(), other.points.begin() + 1, other.points.end());
  other.points[2].at = {110, 110};
  other.points[2].values[0] = number(50);
  const auto a = plan_optimal_law(one, progress), b = plan_optimal_law(other, progress);
  EXPECT_NEAR(a.solution.value.objective, b.solution.value.objective, 1e-7 * a.solution.value.objective);
  EXPECT_NEAR(a.solution.bound->objective, b.solution.bound->objective, 1e-3 * a.solution.value.objective);
  EXPECT_GE(a.solution.value.objective, a.solution.bound->objective);
  EXPECT_LE(a.solution.value.objective, 1.1 * a.solution.bound->objective);
}

TEST(Travel, WithVelocityAloneTheLeastJIsThatOfAStraightLine) {
  Progress progress;
  MotionLawProblem line = problem(100, true, {point(0, 2, {number(0)}), point(50, 2, {{20, 40}})});
  line.travel = 60;
  line.degree = 5;
  line.method = LawMethod::optimal;
  const OptimalLaw law = plan_optimal_law(line, progress);
  EXPECT_NEAR(law.solution.value.objective, 0.6, 1e-6);  // 60 in 100 s, without acceleration
  EXPECT_NEAR(law.solution.bound->objective, 0.6, 1e-3);
}

TEST(Travel, TheShortestCycleOfAnIndexingTableIsInClosedForm) {
  Progress progress;
  MotionLawProblem table = problem(3, true, {rest(0, 0), rest(1, 60)});
  table.travel = 60;
  table.method = LawMethod::optimal;
  table.cycle_duration.reset();
  table.drive = DriveLimits{500, 8000, 400000};
  const OptimalLaw law = plan_optimal_law(table, progress);
  // h/v + v/a + a/j in a third of the cycle.
  EXPECT_NEAR(law.solution.cycle_duration, 3 * (60 / 500.0 + 500 / 8000.0 + 8000 / 400000.0), 1e-9);
}

TEST(Travel, AStraightSectionOverTheEndOfTheCycleHasItsMeanVelocity) {
  Progress progress;
  MotionLawProblem knife = problem(400, true, {point(20, 2, {number(14.4)}), point(380, 2, {number(345.6)})});
  knife.travel = 360;
  knife.points[1].law = ClassicalLaw::straight;  // from 380 to 420, at 28.8 in 40
  knife.method = LawMethod::optimal;
  for (const LawSolution& law :
       {plan_optimal_law(knife, progress).solution, *solve_active_set(knife, {20, 380}, progress)})
    for (const double t : {381.0, 395.0, 400.0, 419.0}) {
      EXPECT_NEAR(law.law.evaluate(t, 0), 345.6 + 0.72 * (t - 380), 1e-9);
      EXPECT_NEAR(law.law.evaluate(t, 1), 0.72, 1e-9);
    }
}

}  // namespace
}  // namespace bahnwerk::cam
