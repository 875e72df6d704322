#include "core/cam/optimal/free_angles.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/progress.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// Every start ends in the J that a scan over the angle finds.
TEST(FreeAngles, StartsEndInTheLeastJOfAScan) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(40, {testing::fixed(11)}, 3));
  const LawBasis basis(make_law_task(problem), 6, 1);
  double least = 1e300;
  for (int k = 0; k <= 60; ++k) {
    problem.points[1].at = {25 + 0.5 * k, 25 + 0.5 * k};
    const LawTask task = make_law_task(problem);
    SplineOptions coarse;
    coarse.gap = 1e-6;
    least = std::min(least, SplineProgram(task, basis, task.middle()).solve(coarse, progress).objective);
  }
  problem.points[1].at = {25, 55};
  const LawTask task = make_law_task(problem);
  const FreeAngles free = optimise_angles(task, basis, 1, progress);
  EXPECT_LE(free.spline.objective, least * (1 + 1e-6));
  EXPECT_GE(free.spline.objective, least * (1 - 1e-2));
  for (const double each : free.start_results) EXPECT_NEAR(each, free.spline.objective, 1e-5 * free.spline.objective);
  EXPECT_GE(free.spline.breaks[1], task.at[1].min);
  EXPECT_LE(free.spline.breaks[1], task.at[1].max);
}

TEST(FreeAngles, SameSeedSameLaw) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(40, {testing::fixed(20)}, 3));
  problem.points[1].at = {30, 70};
  const LawTask task = make_law_task(problem);
  const LawBasis basis(task, 6, 1);
  EXPECT_EQ(optimise_angles(task, basis, 5, progress).spline.coefficients,
            optimise_angles(task, basis, 5, progress).spline.coefficients);
}

/// Where no angle has a law, no start is followed for long.
TEST(FreeAngles, StartsWithoutALawAreGivenUp) {
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(40, {testing::fixed(12)}, 3));
  problem.points[1].at = {30, 50};
  problem.points[0].section[1] = {-1, 1};  // mm/s: too slow for 12 mm
  const LawTask task = make_law_task(problem);
  Progress progress;
  const FreeAngles found = optimise_angles(task, LawBasis(task, 7, 1), 1, progress);
  EXPECT_FALSE(found.spline.feasible);
  EXPECT_LE(found.programs, 20);
}

}  // namespace
}  // namespace bahnwerk::cam
