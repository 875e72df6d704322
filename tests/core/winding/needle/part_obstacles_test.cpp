#include "core/winding/needle/part_obstacles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/winding/needle/clearance.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

TEST(PartObstacles, NamesWhatTheyAre) {
  const StatorPart stator;
  const PartObstacles around = part_obstacles(stator, checked_slot(stator), {}, {{0, 5}, {6, 5}});
  ASSERT_EQ(around.list().size(), 9u);
  EXPECT_EQ(around.name(0), "stack");
  EXPECT_EQ(around.name(8), "winding tool");
  const RotorPart rotor;
  const PartObstacles poles = part_obstacles(rotor, checked_slot(rotor), {.outer_wall = 3});
  ASSERT_EQ(poles.list().size(), 1u + 6 * 2 * 2);
  EXPECT_EQ(poles.name(0), "pole");
  EXPECT_EQ(poles.name(24), "end cap");
  EXPECT_FALSE(poles.list()[0]->convex());
  EXPECT_TRUE(poles.list()[1]->convex());
  EXPECT_THROW(part_obstacles(stator, checked_slot(stator), {.width = -1}, {{0, 5}}), InvalidInput);
}

// Through a rotor's slot beside a shoe, and over the pole where the end cap begins.
TEST(PartObstacles, ANeedleBetweenTwoPoles) {
  const RotorPart part;
  const PartObstacles poles = part_obstacles(part, checked_slot(part));
  // The outer corner of the shoe, Table 4.2.
  const double shoe = std::atan2(10.35 + 2.433, 40.10 + 15.518), outer = std::hypot(10.35 + 2.433, 40.10 + 15.518);
  const double at = shoe + 0.08;
  NeedleMove down{{53 * radial(at) + Vec3{0, 0, 200}, at + std::numbers::pi, 0}, {}, false, 0};
  down.to = down.from;
  down.to.tip.z = 2;
  const Clearance c = clearance({down}, {2.6, 60}, poles.list(), 1e-6, silent);
  EXPECT_EQ(poles.name(c.obstacle), "pole");
  EXPECT_NEAR(c.minimum, outer * std::sin(0.08) - 1.3, 2e-3);
  EXPECT_NEAR(53 + c.along, outer * std::cos(0.08), 0.1);
  // Along the pole above the cap's inner wall, whose foot is at the slot's root and which leans by 30°.
  NeedleMove over{{45 * radial(0) + Vec3{0, -20, 202 + 28 - 5}, std::numbers::pi, 0}, {}, false, 0};
  over.to = over.from;
  over.to.tip.y = 20;
  const Clearance above = clearance({over}, {2.6, 60}, poles.list(), 1e-6, silent);
  EXPECT_EQ(poles.name(above.obstacle), "end cap");
  const double sixty = std::numbers::pi / 3;
  EXPECT_NEAR(above.minimum, (45 + 1.3 - 40.10) * std::sin(sixty) + 12.4 * std::cos(sixty) - 1.3, 1e-6);
}

}  // namespace
}  // namespace bahnwerk::winding
