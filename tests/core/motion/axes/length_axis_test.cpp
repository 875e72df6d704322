// The arc length as one more axis, along paths through kinematics and without.
#include "core/motion/axes/length_axis.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/geometry/curve/line.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "needle_loop.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

TEST(LengthAxis, IsTheArcLengthBehindTheAxesThatAreThere) {
  const test::NeedlePath loop = test::stator_turn();
  for (const test::Winder& winder : test::winders()) {
    const MachinePath machine = machine_path(loop.tool, loop.orientation, winder.configurations);
    const LengthAxisPath path(*machine.axes);
    ASSERT_EQ(path.axes(), 6u);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Curve& curve = loop.tool[i].curve();
      for (const double x : {0.0, 0.3, 1.0}) {
        const double u = curve.begin() + x * (curve.end() - curve.begin());
        AxisJet with = path.at_parameter(i, u);
        EXPECT_NEAR(with.value[5], loop.tool[i].arc_length(u), 1e-12 * loop.tool.length());
        EXPECT_EQ(with.d1[5], 1);
        EXPECT_EQ(with.d2[5], 0);
        EXPECT_EQ(with.d3[5], 0);
        const AxisJet plain = machine.axes->at_parameter(i, u);
        with.value[5] = with.d1[5] = 0;
        EXPECT_EQ(with.value, plain.value);
        EXPECT_EQ(with.d1, plain.d1);
        EXPECT_EQ(with.d3, plain.d3);
      }
      AxisDiscs discs;
      if (const double radius = 1e-3; path.enclose(i, 0.5 * (curve.begin() + curve.end()), radius, discs)) {
        EXPECT_EQ(discs.d1[5].centre, 1);
        EXPECT_EQ(discs.d1[5].radius, 0);
        EXPECT_TRUE(discs.d3[5].zero());
      }
    }
  }
}

TEST(LengthAxis, BatchesOfPlanarPathsHaveNoStaleRows) {
  Path line;
  line.append(std::make_shared<Line>(Vec{0, 0, 0}, Vec{30, 40, 0}), 0);
  const CartesianAxisPath flat(line, 3);
  const LengthAxisPath path(flat);
  PathBatch batch;
  for (std::size_t k = 0; k < max_axes; ++k) batch.d1[k].set(0, 7), batch.d2[k].set(0, 7), batch.d3[k].set(0, 7);
  batch.count = 1, batch.u.set(0, 0.5);
  path.at_parameters(0, batch);
  EXPECT_FALSE(batch.planar);
  const AxisJet q = path.at_parameter(0, 0.5);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(batch.d1[k][0], q.d1[k], 1e-15);
    EXPECT_EQ(batch.d2[k][0], 0);
    EXPECT_EQ(batch.d3[k][0], 0);
  }
  EXPECT_NEAR(q.value[3], 25, 1e-12);
}

/// From rest with the largest jerk throughout, back to rest the same way: v = (4.5 J s²)^(1/3), a² = 2 J v.
TEST(LengthAxis, TheLargestAccelerationIsThatOfJerkFromRest) {
  const double J = 500, length = 12, t = 0.4;
  const double s = J * t * t * t / 6, v = J * t * t / 2, a = J * t;
  EXPECT_NEAR(largest_acceleration({unlimited, unlimited, J}, s), a, 1e-8 * a);
  EXPECT_NEAR(largest_acceleration({v, unlimited, J}, length), a, 1e-8 * a);
  EXPECT_EQ(largest_acceleration({v, 0.9 * a, J}, length), 0.9 * a);
  EXPECT_EQ(largest_acceleration({v}, length), unlimited);
}

}  // namespace
}  // namespace bahnwerk
