#include "core/winding/part/vec3.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace bahnwerk::winding {
namespace {

TEST(Vec3, RotationsAddUpAndKeepHeightAndRadius) {
  const Vec3 a{3, -4, 7};
  const Vec3 once = turned(a, 0.9), twice = turned(turned(a, 0.4), Rotation(0.5));
  EXPECT_NEAR(norm(once - twice), 0, 1e-14);
  EXPECT_EQ(once.z, 7);
  EXPECT_NEAR(std::hypot(once.x, once.y), 5, 1e-14);
}

TEST(Vec3, TheAzimuthIsTheAngleFromTheFirstAxis) {
  for (const double angle : {-3.0, -0.2, 0.0, 1.5, 3.1}) {
    EXPECT_NEAR(azimuth(radial(angle)), angle, 1e-15);
    EXPECT_NEAR(azimuth(turned({2, 0, 5}, angle)), angle, 1e-15);
    EXPECT_EQ(radial(angle).z, 0);
  }
  EXPECT_NEAR(norm(turned({1, 0, 0}, std::numbers::pi / 2) - Vec3{0, 1, 0}), 0, 1e-15);
}

}  // namespace
}  // namespace bahnwerk::winding
