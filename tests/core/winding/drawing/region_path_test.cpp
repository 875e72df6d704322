#include "core/winding/drawing/region_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace bahnwerk::winding {
namespace {

/// 10 px per mm, y downwards.
Point frame(Point p) { return {10 * p.x, -10 * p.y}; }

TEST(RegionPath, ALoopOfLinesIsItsCornersAndCloses) {
  const Region square({line({0, 0}, {2, 0}), line({2, 0}, {2, 1}), line({2, 1}, {0, 1}), line({0, 1}, {0, 0})});
  EXPECT_EQ(region_path(square, frame, 10), "M0 0L20 0L20 -10L0 -10L0 0Z");
  EXPECT_EQ(region_path(Region(), frame, 10), "");
}

TEST(RegionPath, ACircleIsTwoHalvesTurningAsItDoes) {
  const Region disc({arc({0, 0}, 1, 0, 2 * std::numbers::pi)});
  EXPECT_EQ(region_path(disc, frame, 10), "M10 0A10 10 0 0 0 -10 0A10 10 0 0 0 10 0Z");
}

TEST(RegionPath, EveryPartIsALoopOfItsOwn) {
  const auto rectangle = [](double left, double right, double low, double high) {
    return Region({line({left, low}, {right, low}), line({right, low}, {right, high}),
                   line({right, high}, {left, high}), line({left, high}, {left, low})});
  };
  const Region halves = rectangle(0, 4, 0, 1).without(rectangle(1, 3, -1, 2));
  const std::string d = region_path(halves, frame, 10);
  EXPECT_EQ(std::count(d.begin(), d.end(), 'M'), 2);
  EXPECT_EQ(std::count(d.begin(), d.end(), 'Z'), 2);
  EXPECT_EQ(std::count(d.begin(), d.end(), 'L'), 8);
}

}  // namespace
}  // namespace bahnwerk::winding
