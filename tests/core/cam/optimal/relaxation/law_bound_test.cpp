#include "core/cam/optimal/relaxation/law_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/progress.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

TEST(LawBound, BoxesOfAnglesHoldForEveryAngleInThem) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(40, {testing::fixed(12)}, 3));
  double least = 1e300;
  const LawBasis basis(make_law_task(problem), 6, 2);
  for (const double at : {30.0, 35.0, 40.0, 50.0}) {
    problem.points[1].at = {at, at};
    const LawTask task = make_law_task(problem);
    least = std::min(least, testing::solve(task, basis).objective);
  }
  problem.points[1].at = {30, 50};
  const LawTask task = make_law_task(problem);
  const KnownLaw law(task, basis, testing::solve(task, basis));
  const AllLawsBound one = bound_over_angles(task, law, 1, 1e-3, progress);
  const AllLawsBound many = bound_over_angles(task, law, 20, 1e-3, progress);
  EXPECT_LE(one.objective, many.objective * (1 + 1e-6));
  EXPECT_LE(many.objective, least);
  EXPECT_GE(many.objective, 0.9 * least);
}

/// A range that reaches beyond the next point: no law has its point there, and the bound stays below every law.
TEST(LawBound, RangesThatOverlapTheNextPointHoldForEveryAngleInThem) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(10, {testing::fixed(3)}));
  problem.points.insert(problem.points.begin() + 2, testing::point_at(30, {testing::fixed(18)}));
  const LawBasis basis(make_law_task(problem), 5, 4);
  double least = 1e300;
  for (const double at : {5.0, 10.0, 15.0, 20.0}) {
    problem.points[1].at = {at, at};
    least = std::min(least, testing::solve(make_law_task(problem), basis).objective);
  }
  problem.points[1].at = {5, 80};
  const LawTask task = make_law_task(problem);
  EXPECT_EQ(task.at[1].max, task.at[2].min);
  const KnownLaw law(task, basis, testing::solve(task, basis));
  const AllLawsBound bound = bound_over_angles(task, law, 30, 1e-3, progress);
  EXPECT_LE(bound.objective, least);
  EXPECT_GE(bound.objective, 0.8 * least);
}

}  // namespace
}  // namespace bahnwerk::cam
