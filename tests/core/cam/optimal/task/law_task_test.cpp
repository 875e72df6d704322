#include "core/cam/optimal/task/law_task.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

using testing::fixed;
using testing::point_at;

TEST(LawTask, UnitsAreTheMeanSectionAndTheSpanOfThePositions) {
  MotionLawProblem problem = testing::rest_to_rest(30, 0.6);
  problem.points.insert(problem.points.begin() + 1, point_at(45, {Range{12, 14}, fixed(80)}));
  problem.points[0].section[1] = {-60, 200};
  const LawTask task = make_law_task(problem);
  EXPECT_DOUBLE_EQ(task.unit_time, 0.3);
  EXPECT_DOUBLE_EQ(task.unit_position, 30);
  EXPECT_DOUBLE_EQ(task.cycle, 2);
  EXPECT_DOUBLE_EQ(task.at[1].min, 1);
  EXPECT_NEAR(task.limits[0][1].max, 200 * 0.3 / 30, 1e-14);
  EXPECT_NEAR(task.weight[2] * task.to_task(2), problem.objective.weight[2], 1e-14);
  ASSERT_EQ(task.conditions.size(), 8u);
  EXPECT_NEAR(task.conditions[3].range.min, 12.0 / 30, 1e-14);
  EXPECT_NEAR(task.conditions[4].range.max, 80 * 0.3 / 30, 1e-14);
}

/// A rise and a fall that may not turn back meet at a point that rests.
TEST(LawTask, LimitsOfNeighboursThatLeaveOneValuePinIt) {
  MotionLawProblem problem = testing::rest_to_rest(0, 1);
  problem.points.insert(problem.points.begin() + 1, point_at(40, {fixed(20)}));
  problem.points[0].section[1].min = 0;
  problem.points[1].section[1].max = 0;
  const LawTask task = make_law_task(problem);
  const LawTask::Condition& pinned = task.conditions.back();
  EXPECT_EQ(pinned.point, 1u);
  EXPECT_EQ(pinned.order, 1);
  EXPECT_EQ(pinned.range.min, 0);
  EXPECT_TRUE(pinned.range.fixed());
}

TEST(LawTask, RangesLoseWhatTheOrderOfThePointsExcludes) {
  LawTask task;
  task.periodic = true;
  task.cycle = 10;
  std::vector<Range> at{{0, 4}, {3, 3}, {1, 8}, {2, 14}};
  EXPECT_TRUE(tighten(task, at));
  const std::vector<Range> expected{{0, 3}, {3, 3}, {3, 8}, {3, 13}};
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_EQ(at[i].min, expected[i].min) << i;
    EXPECT_EQ(at[i].max, expected[i].max) << i;
  }
  at = {{5, 6}, {1, 4}, {7, 8}};
  EXPECT_FALSE(tighten(task, at));
}

TEST(LawTask, VibrationGoesFromOnePointThatStandsStillToTheNext) {
  MotionLawProblem problem = testing::rest_to_rest(10, 0.5);
  problem.points.insert(problem.points.begin() + 1, point_at(40, {fixed(5)}));
  problem.points[0].still = problem.points[2].still = true;
  problem.vibration = {{4, 0.1}, {9, 0}};
  const LawTask task = make_law_task(problem);
  ASSERT_EQ(task.vibration.size(), 2u);
  EXPECT_EQ(task.vibration[0].from, 0u);
  EXPECT_EQ(task.vibration[0].to, 2u);
  EXPECT_NEAR(task.vibration[0].decay, 0.1 * 2 * 3.14159265358979 * 4 * 0.25, 1e-12);
}

/// 10, 5 … 10, 5, 0 mm, falling.
MotionLawProblem falling() {
  MotionLawProblem problem;
  problem.length = 90;
  problem.cycle_duration = 1;
  problem.points = {point_at(0, {fixed(10)}), point_at(20, {Range{5, 10}}), point_at(50, {fixed(10)}),
                    point_at(90, {fixed(0)})};
  for (std::size_t i = 0; i < 3; ++i) problem.points[i].section[1].max = 0;
  return problem;
}

TEST(LawTask, MonotoneSectionsBetweenEqualPositionsAreConstant) {
  const LawTask task = make_law_task(falling());
  EXPECT_EQ(task.constant_velocity(0), 0);
  EXPECT_EQ(task.constant_velocity(1), 0);
  EXPECT_FALSE(task.constant_velocity(2));
  // The section behind begins without acceleration.
  bool found = false;
  for (const LawTask::Condition& condition : task.conditions)
    found =
        found || (condition.point == 2 && condition.order == 2 && condition.range.min == 0 && condition.range.fixed());
  EXPECT_TRUE(found);
}

TEST(LawTask, ALimitThatIsTheMeanVelocityMakesASectionStraight) {
  MotionLawProblem problem = falling();
  problem.points[2].section[1] = {-10 / (40.0 / 90), 0};
  EXPECT_TRUE(make_law_task(problem).constant_velocity(2));
}

TEST(LawTask, EndsKeepThePositionLimitsOfMonotoneSections) {
  MotionLawProblem problem = falling();
  problem.points[2].section[0].min = 0;
  EXPECT_TRUE(make_law_task(problem).limits[2][0].free());
  problem.points[2].section[0].min = 1;  // nothing keeps it
  EXPECT_FALSE(make_law_task(problem).limits[2][0].free());
}

}  // namespace
}  // namespace bahnwerk::cam
