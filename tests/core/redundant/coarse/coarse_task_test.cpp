#include "core/redundant/coarse/coarse_task.hpp"

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

TEST(CoarseTask, RestsAreWhereTangentOrCurvatureJump) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, unlimited);
  b.line({10, 0, 0});
  b.line({20, 0, 0});                   // goes on
  b.arc({20, 4, 0}, {20, 2, 0}, true);  // tangential
  b.line({0, 8, 0});                    // a corner
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const std::vector<bool> rests = rests_at_jumps(*task.path, task.rests);
  EXPECT_EQ(std::vector<bool>(rests.begin() + 1, rests.begin() + 4), (std::vector<bool>{false, true, true}));
  for (const CoarseFineAxis& axis : without_fine_axes(task).machine.axes) EXPECT_EQ(axis.stroke, 0);
  EXPECT_EQ(without_fine_axes(task).rests, task.rests);
}

/// Points 20 mm away (10 mm from zero, 10 mm long) are off by 1.4e-13 mm at most, which turns either line by 1.4e-14;
/// an angle of 1e-10 is no rounding.
TEST(CoarseTask, RoundingIsThatOfThePoints) {
  for (const auto& [angle, rests] : {std::pair{2e-14, false}, {1e-10, true}}) {
    ContourBuilder b(2, {0, 0, 0});
    b.block(Mode::cut, unlimited);
    b.line({10, 0, 0});
    b.line({20, 10 * angle, 0});
    const JointTask task = test::joint_task(b.finish(), test::md2());
    EXPECT_EQ(rests_at_jumps(*task.path, task.rests)[1], rests) << angle;
  }
}

/// A curve whose radius of curvature is 5e10 mm is off by no more than a line.
TEST(CoarseTask, AHardlyBentCurveHasTheRoundingOfALine) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, unlimited);
  b.polynomial({{0, 10}, {0, 0, 1e-9}});
  b.line({20, 1e-5, 0});
  const JointTask task = test::joint_task(b.finish(), test::md2());
  EXPECT_TRUE(rests_at_jumps(*task.path, task.rests)[1]);
}

}  // namespace
}  // namespace bahnwerk
