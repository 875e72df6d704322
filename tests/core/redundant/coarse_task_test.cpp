#include "core/redundant/coarse_task.hpp"

#include <gtest/gtest.h>

#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

TEST(CoarseTask, LimitsAreAPartOfTheCoarseAxes) {
  const Machine machine = coarse_machine(test::with_jerk(test::md2(), 80), 0.5);
  ASSERT_EQ(machine.axes.size(), 2u);
  EXPECT_EQ(machine.axes[1].name, "y");
  EXPECT_EQ(machine.axes[1].velocity, 900);
  EXPECT_EQ(machine.axes[1].acceleration, 8000);
  EXPECT_EQ(machine.axes[1].jerk, 640000);
  EXPECT_FALSE(coarse_machine(test::md2(), 0.5).axes[0].jerk < unlimited);
}

TEST(CoarseTask, TheToolRestsWhereTheTangentJumpsWithLimitedJerkWhereCurvatureDoes) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, unlimited);
  b.line({10, 0, 0});
  b.arc({10, 4, 0}, {10, 2, 0}, true);  // tangential
  b.line({0, 8, 0});                    // a corner
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const std::vector<bool> tangents = resting_at_jumps(task).rests;
  EXPECT_FALSE(tangents[1]);
  EXPECT_TRUE(tangents[2]);
  JointTask jerk = task;
  jerk.machine = test::with_jerk(test::md2(), 80);
  EXPECT_TRUE(resting_at_jumps(jerk).rests[1]);
  EXPECT_FALSE(task.rests[1]);
  for (const CoarseFineAxis& axis : without_fine_axes(task).machine.axes) EXPECT_EQ(axis.stroke, 0);
}

/// Points 20 mm away (10 mm from zero, 10 mm long) are off by 1.4e-13 mm at most, which turns either line by 1.4e-14;
/// an angle of 1e-10 is no rounding.
TEST(CoarseTask, RoundingIsThatOfThePoints) {
  for (const auto& [angle, rests] : {std::pair{2e-14, false}, {1e-10, true}}) {
    ContourBuilder b(2, {0, 0, 0});
    b.block(Mode::cut, unlimited);
    b.line({10, 0, 0});
    b.line({20, 10 * angle, 0});
    EXPECT_EQ(resting_at_jumps(test::joint_task(b.finish(), test::md2())).rests[1], rests) << angle;
  }
}

}  // namespace
}  // namespace bahnwerk
