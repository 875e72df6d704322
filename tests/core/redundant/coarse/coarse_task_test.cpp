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

/// A circle of radius 4 mm about x = 10 mm.
TEST(CoarseTask, APathBeyondARangeIsFoundByItsCurves) {
  CoarseFineMachine machine = test::md2();
  machine.axes[0].coarse.lowest = 0, machine.axes[0].coarse.highest = 12;
  ContourBuilder b(2, {10, 4, 0});
  b.block(Mode::cut, unlimited);
  b.arc({10, 4, 0}, {10, 0, 0}, true);
  const RedundancyTask task = test::redundancy_task(b.finish(), machine);
  EXPECT_EQ(beyond_coarse_range(*task.path, machine), std::vector<std::size_t>{0});
  EXPECT_FALSE(within_coarse_range(*task.path, machine, 0.05));
  EXPECT_TRUE(within_coarse_range(*task.path, machine, 0.15));
}

}  // namespace
}  // namespace bahnwerk
