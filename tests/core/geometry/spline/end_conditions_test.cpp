#include "core/geometry/spline/end_conditions.hpp"

#include <gtest/gtest.h>

#include <array>

namespace bahnwerk {
namespace {

TEST(EndConditions, ControlPointsOfAPowerAreThoseOfItsBlossom) {
  // s(v) = v² has the blossom v1 v2; raised to degree 5, point i is i(i − 1)/(5·4).
  std::array<double, spline_orders> derivatives{};
  derivatives[2] = 2;
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(end_point(derivatives, 5, i), static_cast<double>(i * (i - (i > 0 ? 1 : 0))) / 20, 1e-15) << i;
}

TEST(EndConditions, ValueAndSlopeAreTheFirstTwoPoints) {
  std::array<double, spline_orders> derivatives{};
  derivatives[0] = 3, derivatives[1] = 14;
  EXPECT_EQ(end_point(derivatives, 7, 0), 3);
  EXPECT_DOUBLE_EQ(end_point(derivatives, 7, 1), 5);
  EXPECT_DOUBLE_EQ(end_point(derivatives, 7, 4), 11);  // a straight line
}

}  // namespace
}  // namespace bahnwerk
