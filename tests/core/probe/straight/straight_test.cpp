#include "core/probe/straight/straight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk::probe {
namespace {

TEST(Straight, AlongADirectionTheTightestAxisCounts) {
  ProbeProblem p = probe_cases::problem({{0, 0}, {3, 4}}, 0);
  p.machine.axes[0].acceleration = 60, p.machine.axes[1].jerk = 80;
  const Limits limits = limits_along(p, {0.6, 0.8});
  EXPECT_DOUBLE_EQ(limits.acceleration, 100);
  EXPECT_DOUBLE_EQ(limits.jerk, 100);
  EXPECT_DOUBLE_EQ(limits.snap, 250000);
  EXPECT_EQ(limits.velocity, p.speed);
  EXPECT_EQ(limits_along(p, {-1, 0}).acceleration, 60) << "an axis that stands still limits nothing";
}

TEST(Straight, ATinyMoveIsLimitedBySnapAlone) {
  // Eight ramps of T/8: the speed reached is 2 S (T/8)³, the way 8 S (T/8)⁴.
  const double x = 1e-6;
  const ProbeProblem p = probe_cases::problem({{0, 0}, {x, 0}}, 0);
  const double found = rest_to_rest_duration(p, 0, 1);
  EXPECT_NEAR(found, std::pow(512 * x / 200000, 0.25), 1e-9 * found);
}

TEST(Straight, PointsBetweenArePassedWhereTheyAre) {
  const ProbeProblem p = probe_cases::problem({{0, 0}, {0.5, 0}, {3, 0}, {3.5, 0}, {7, 0}}, 0);
  MotionWriter writer(p);
  const double duration = append_rest_to_rest(writer, p, 0, 4);
  const ProbeMotion motion = writer.finish();
  EXPECT_NEAR(motion.duration(), duration, 1e-12);
  ASSERT_EQ(motion.times.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(motion.motion->evaluate(motion.times[i])[0][0], p.points[i].x, 1e-9) << i;
  probe_cases::expect_right(p, motion);
}

}  // namespace
}  // namespace bahnwerk::probe
