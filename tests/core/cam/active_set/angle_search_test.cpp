#include "core/cam/active_set/angle_search.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/active_set/active_set.hpp"
#include "tests/core/cam/problems.hpp"

namespace bahnwerk::cam {
namespace {

using namespace testing_problems;

TEST(AngleSearch, AFreeAngleIsNoWorseThanAnyOfAFineGrid) {
  MotionLawProblem p = problem(140, false, {rest(0, 0), point(70, 4, {number(20)}), rest(140, 45)});
  p.points[1].at = {40, 100};
  Progress progress;
  const LawSolution found = *plan_active_set(p, progress);
  EXPECT_GE(found.at[1], 40);
  EXPECT_LE(found.at[1], 100);
  for (double at = 40; at <= 100; at += 2.5)
    EXPECT_LE(found.value.objective, solve_active_set(p, {0, at, 140}, progress)->value.objective * (1 + 1e-9)) << at;
}

TEST(AngleSearch, FaultsThatNoAngleMendsAreThoseOfTheSpline) {
  MotionLawProblem p = problem(100, false, {point(0, 2, {}), point(50, -1, {}), point(100, 2, {})});
  p.points[1].continuity = 0;
  p.points[1].at = {40, 60};
  Progress progress;
  EXPECT_THROW(plan_active_set(p, progress), PlanningError);
}

}  // namespace
}  // namespace bahnwerk::cam
