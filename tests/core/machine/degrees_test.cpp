#include "core/machine/degrees.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace bahnwerk {
namespace {

TEST(Degrees, RotaryAxesHaveUnitLimitsAndRangeInDeg) {
  constexpr double turn = 2 * std::numbers::pi;
  AxisLimits theta("theta", turn, 2 * turn);
  theta.unit = "rad", theta.lowest = -turn, theta.highest = turn / 2;
  const Machine shown = in_degrees({{theta, AxisLimits("r", 600)}, 0.002});
  EXPECT_EQ(shown.cycle_time, 0.002);
  EXPECT_EQ(shown.axes[0].unit, "deg");
  EXPECT_DOUBLE_EQ(shown.axes[0].velocity, 360);
  EXPECT_DOUBLE_EQ(shown.axes[0].acceleration, 720);
  EXPECT_EQ(shown.axes[0].jerk, unlimited);
  EXPECT_DOUBLE_EQ(shown.axes[0].lowest, -360);
  EXPECT_DOUBLE_EQ(shown.axes[0].highest, 180);
  EXPECT_EQ(shown.axes[1].unit, "mm");
  EXPECT_EQ(shown.axes[1].velocity, 600);
}

}  // namespace
}  // namespace bahnwerk
