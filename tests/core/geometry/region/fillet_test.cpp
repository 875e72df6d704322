#include "core/geometry/region/fillet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace bahnwerk {
namespace {

std::vector<Edge> square(double side) {
  return {line({0, 0}, {side, 0}), line({side, 0}, {side, side}), line({side, side}, {0, side}),
          line({0, side}, {0, 0})};
}

TEST(Fillet, ARightAngleLosesTheAreaOutsideItsQuarterCircle) {
  std::vector<Edge> loop = square(10);
  ASSERT_TRUE(round_corner(loop, 0, 2));
  ASSERT_EQ(loop.size(), 5u);
  EXPECT_EQ(loop[1].radius, 2);
  EXPECT_NEAR(loop[1].turn, std::numbers::pi / 2, 1e-12);
  double doubled = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    doubled += loop[i].doubled_area();
    const Edge& next = loop[(i + 1) % loop.size()];
    EXPECT_NEAR(distance(loop[i].to, next.from), 0, 1e-12);
  }
  EXPECT_NEAR(doubled / 2, 100 - 4 * (1 - std::numbers::pi / 4), 1e-12);
  EXPECT_NEAR(cross(loop[0].direction(1), loop[1].direction(0)), 0, 1e-12);  // tangent on both sides
  EXPECT_NEAR(cross(loop[1].direction(1), loop[2].direction(0)), 0, 1e-12);
}

TEST(Fillet, ARadiusThatDoesNotFitLeavesTheLoopAsItIs) {
  std::vector<Edge> loop = square(10);
  EXPECT_FALSE(round_corner(loop, 0, 11));
  ASSERT_EQ(loop.size(), 4u);
  EXPECT_EQ(loop[0].to, (Point{10, 0}));
}

TEST(Fillet, CornersThatTurnRightStay) {
  std::vector<Edge> loop{line({0, 0}, {10, 0}), line({10, 0}, {10, 10}), line({10, 10}, {5, 4}), line({5, 4}, {0, 10}),
                         line({0, 10}, {0, 0})};
  EXPECT_TRUE(round_corner(loop, 2, 0.5));  // nothing to round
  EXPECT_EQ(loop.size(), 5u);
}

}  // namespace
}  // namespace bahnwerk
