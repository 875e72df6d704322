#include "core/cam/optimal/forced_sections.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// 10, 5 … 10, 5, 0 mm, falling.
MotionLawProblem falling() {
  MotionLawProblem problem;
  problem.length = 90;
  problem.cycle_duration = 1;
  problem.points = {testing::point_at(0, {testing::fixed(10)}), testing::point_at(20, {Range{5, 10}}),
                    testing::point_at(50, {testing::fixed(10)}), testing::point_at(90, {testing::fixed(0)})};
  for (std::size_t i = 0; i < 3; ++i) problem.points[i].section[1].max = 0;
  return problem;
}

TEST(ForcedSections, MonotoneSectionsBetweenEqualPositionsAreConstant) {
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

TEST(ForcedSections, ALimitThatIsTheMeanVelocityMakesASectionStraight) {
  MotionLawProblem problem = falling();
  problem.points[2].section[1] = {-10 / (40.0 / 90), 0};
  EXPECT_TRUE(make_law_task(problem).constant_velocity(2));
}

TEST(ForcedSections, EndsKeepThePositionLimitsOfMonotoneSections) {
  MotionLawProblem problem = falling();
  problem.points[2].section[0].min = 0;
  EXPECT_TRUE(make_law_task(problem).limits[2][0].free());
  problem.points[2].section[0].min = 1;  // nothing keeps it
  EXPECT_FALSE(make_law_task(problem).limits[2][0].free());
}

}  // namespace
}  // namespace bahnwerk::cam
