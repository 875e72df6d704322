#include "core/machine/kinematics.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(CartesianKinematics, AxesAreTheToolsCoordinates) {
  const Cartesian machine({{"x", 100}, {"y", 100}, {"z", 100}});
  ToolJet tool;
  tool.position = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}};
  const AxisJet q = machine.inverse(tool);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(q.value[k], tool.position.value[k]);
    EXPECT_EQ(q.d1[k], tool.position.d1[k]);
    EXPECT_EQ(q.d2[k], tool.position.d2[k]);
    EXPECT_EQ(q.d3[k], tool.position.d3[k]);
  }
  for (std::size_t k = 3; k < max_axes; ++k) EXPECT_EQ(q.value[k], 0);
  EXPECT_EQ(machine.forward(q.value).position, tool.position.value);
}

TEST(CartesianKinematics, APlanarMachineLeavesOutTheThirdCoordinate) {
  const Cartesian machine({{"x", 100}, {"y", 100}});
  ToolJet tool;
  tool.position.value = {1, 2, 3};
  EXPECT_EQ(machine.inverse(tool).value[2], 0);
  const MapBounds bounds = machine.bounds({}, 10);
  EXPECT_EQ(bounds.order[0][1], 1);  // a direction of unit length moves an axis by 1 at most
  EXPECT_EQ(bounds.order[0][2], 0);
  EXPECT_EQ(bounds.order[1][0], 0);
}

/// Says nothing of itself but what it has to.
struct Unknown : Kinematics {
  std::vector<AxisLimits> list{{"a", 1}};
  const std::vector<AxisLimits>& axes() const override { return list; }
  AxisJet inverse(const ToolJet&) const override { return {}; }
  ToolPose forward(const AxisArray&) const override { return {}; }
  MapBounds bounds(const ToolPose&, double) const override { return {}; }
};

TEST(Kinematics, WhatAMachineDoesNotStateIsUnknown) {
  const Unknown machine;
  AxisDiscs discs;
  EXPECT_FALSE(machine.enclose({}, discs));
  EXPECT_EQ(machine.period(0), 0);
  EXPECT_EQ(machine.lever(), 0);
  for (const AxisArray& order : machine.complex_bounds({}, 1).order) EXPECT_EQ(order[0], unlimited);
}

}  // namespace
}  // namespace bahnwerk
