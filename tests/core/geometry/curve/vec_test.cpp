#include "core/geometry/curve/vec.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace bahnwerk {
namespace {

TEST(Vec, TheCrossProductIsPerpendicularAndAsLongAsTheParallelogramIsLarge) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int i = 0; i < 100; ++i) {
    const Vec a{any(random), any(random), any(random)}, b{any(random), any(random), any(random)}, c = cross(a, b);
    EXPECT_NEAR(dot(a, c), 0, 1e-13);
    EXPECT_NEAR(dot(b, c), 0, 1e-13);
    EXPECT_NEAR(dot(c, c), dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b), 1e-11);  // Lagrange's identity
    EXPECT_EQ(cross(b, a), -c);
  }
  EXPECT_EQ(cross(Vec{1, 0, 0}, Vec{0, 1, 0}), (Vec{0, 0, 1}));
}

TEST(Vec, TinyAnglesAreAccurate) {
  for (const double angle : {1e-12, 1e-9, 1e-3, 1.0, std::numbers::pi - 1e-9})
    EXPECT_NEAR(angle_between({2, 0, 0}, {3 * std::cos(angle), 3 * std::sin(angle), 0}), angle, 2e-16 + 1e-12 * angle);
  EXPECT_EQ(angle_between({1, 1, 0}, {2, 2, 0}), 0);
}

TEST(Vec, IndicesAreCoordinates) {
  Vec a{1, 2, 3};
  a[1] = 7;
  EXPECT_EQ(a, (Vec{1, 7, 3}));
  EXPECT_EQ(a[0] + 10 * a[1] + 100 * a[2], 371);
}

}  // namespace
}  // namespace bahnwerk
