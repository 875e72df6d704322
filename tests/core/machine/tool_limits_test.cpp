#include "core/machine/tool_limits.hpp"

#include <gtest/gtest.h>

#include "core/machine/linear_machine.hpp"
#include "core/machine/polar_machine.hpp"

namespace bahnwerk {
namespace {

const Machine three{{{"x", 300, 3000, 30}, {"y", 400, 4000, 40}, {"z", 1200, 12000, 120}}, 0.001};

TEST(ToolLimits, OfACartesianMachineAreSidesAndDiagonals) {
  const ToolLimits t = tool_limits(three);
  EXPECT_EQ(t.acceleration, 3000);
  EXPECT_EQ(t.jerk, 30);
  EXPECT_EQ(t.speed, 1300);
  EXPECT_EQ(t.pull, 13000);
  const ToolLimits through = tool_limits(Cartesian(three.axes), three, 3, {1, 2, 3});
  EXPECT_DOUBLE_EQ(through.acceleration, t.acceleration);
  EXPECT_DOUBLE_EQ(through.jerk, t.jerk);
  EXPECT_DOUBLE_EQ(through.speed, t.speed);
  EXPECT_DOUBLE_EQ(through.pull, t.pull);
}

TEST(ToolLimits, FollowTheJacobian) {
  AxisLimits theta("theta", 2, 20, 200), r("r", 50, 500, 5000);
  theta.unit = "rad";
  const Machine limits{{theta, r}, 0.001};
  const PolarMachine machine({{}, 1}, limits.axes);
  const ToolLimits at100 = tool_limits(machine, limits, 2, {60, 80, 0}),
                   at10 = tool_limits(machine, limits, 2, {10, 0, 0});
  EXPECT_NEAR(at100.acceleration, 500, 1e-9);  // that of r; theta allows 20 · 100
  EXPECT_NEAR(at10.acceleration, 200, 1e-9);   // theta's at 10 mm
  EXPECT_GE(at100.speed, std::hypot(200, 50));
  EXPECT_LE(at10.speed, 20 + 50 + 1e-9);
  EXPECT_THROW(tool_limits(machine, limits, 2, {0.1, 0, 0}), UnreachablePose);
}

TEST(ToolLimits, AMapIsAskedForThePlaceWhereLimitsDependOnIt) {
  const ToolLimitsMap equal(three);
  EXPECT_EQ(equal.at([]() -> Vec { throw std::logic_error("no place is needed"); }).speed, 1300);
  EXPECT_EQ(equal.cycle_time, 0.001);
  const ToolLimitsMap map([](Vec at) { return ToolLimits{at.x, 1, 2, 3}; }, 0.002);
  EXPECT_EQ(map.at([] { return Vec{7, 0, 0}; }).speed, 7);
  EXPECT_EQ(map.cycle_time, 0.002);
}

}  // namespace
}  // namespace bahnwerk
