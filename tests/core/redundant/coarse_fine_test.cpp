#include "core/redundant/coarse_fine.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(CoarseFine, TheToolMayDoWhatBothAxesMayTogether) {
  CoarseFineMachine machine;
  CoarseFineAxis axis{"x", {1800, 16000}, {2000, 60000}, 20};
  axis.coarse.lowest = 0;
  axis.coarse.highest = 1000;
  machine.axes = {axis};
  EXPECT_EQ(machine.limited_order(), 2);
  const Machine sum = summed(machine);
  ASSERT_EQ(sum.axes.size(), 1u);
  EXPECT_EQ(sum.axes[0].name, "x");
  EXPECT_EQ(sum.axes[0].velocity, 3800);
  EXPECT_EQ(sum.axes[0].acceleration, 76000);
  EXPECT_EQ(sum.axes[0].jerk, unlimited);
  EXPECT_EQ(sum.axes[0].lowest, -20);
  EXPECT_EQ(sum.axes[0].highest, 1020);
  machine.axes[0].coarse.jerk = 1e6;
  EXPECT_EQ(machine.limited_order(), 3);
}

TEST(CoarseFine, TheHeadChangesItsAccelerationNoFasterThanTheSlowerAxisItsShare) {
  CoarseFineMachine machine;
  machine.axes = {{"x", {1800, 10000, 1e6}, {2000, 40000, 8e6}, 20},
                  {"y", {1800, 10000, 2e6}, {2000, 40000, 8e6}, 20},
                  {"z", {1800, 10000}, {2000, 40000}, 20}};
  const Machine head = head_limits(machine);
  EXPECT_DOUBLE_EQ(head.axes[0].jerk, 5e6);  // the coarse axis takes 20 ms from end to end, the head 100 000/5e6
  EXPECT_DOUBLE_EQ(head.axes[1].jerk, 1e7);  // both take equally long: the sum
  EXPECT_EQ(head.axes[2].jerk, unlimited);
  EXPECT_EQ(head.axes[0].acceleration, 50000);
}

}  // namespace
}  // namespace bahnwerk
