#include "core/winding/layout/count_bound.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk::winding {
namespace {

using std::numbers::pi;

using test::polygon;

// Oler's inequality is an equality for triangles full of touching circles.
TEST(CountBound, IsExactInTrianglesOfWires) {
  for (int rows = 1; rows < 12; ++rows) {
    const double side = 2 * (rows - 1) + 2 * std::sqrt(3.0);  // of radius 1
    const Region usable_area = polygon({{0, 0}, {side, 0}, {side / 2, side * std::sqrt(3.0) / 2}});
    EXPECT_EQ(max_wires(usable_area, 1, 2), static_cast<std::size_t>(rows * (rows + 1) / 2)) << rows;
  }
}

TEST(CountBound, IsNoLessThanWhatIsKnownToFit) {
  // 7 circles in a circle of three times their radius; 4 in a square of twice their diameter.
  const Region disc({arc({0, 0}, 3, 0, 2 * pi)});
  EXPECT_GE(max_wires(disc, 1, 2), 7u);
  EXPECT_LE(max_wires(disc, 1, 2), 8u);
  EXPECT_GE(max_wires(polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), 1, 2), 4u);
  EXPECT_EQ(max_wires(disc, 3.1, 6.2), 0u);
}

TEST(CountBound, AllowedOverlapRaisesIt) {
  const Region disc({arc({0, 0}, 10, 0, 2 * pi)});
  EXPECT_GT(max_wires(disc, 1, 1.9), max_wires(disc, 1, 2));
}

}  // namespace
}  // namespace bahnwerk::winding
