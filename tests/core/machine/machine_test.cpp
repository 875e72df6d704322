#include "core/machine/machine.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Machine, LimitsOfAnAxisAreVelocityAccelerationJerkAndWhatIsNotGivenIsInfinite) {
  const AxisLimits x("x", 1800, 16000, 4e5), y("y", 900);
  EXPECT_EQ(x.velocity, 1800);
  EXPECT_EQ(x.acceleration, 16000);
  EXPECT_EQ(x.jerk, 4e5);
  EXPECT_EQ(x.snap, unlimited);
  EXPECT_EQ(x.unit, "mm");
  EXPECT_EQ(y.velocity, 900);
  EXPECT_EQ(y.acceleration, unlimited);
  EXPECT_EQ(y.jerk, unlimited);
  const AxisLimits renamed("u", x);
  EXPECT_EQ(renamed.name, "u");
  EXPECT_EQ(renamed.jerk, x.jerk);
  EXPECT_EQ((Machine{{x, y}, 0.002}.dimension()), 2u);
}

}  // namespace
}  // namespace bahnwerk
