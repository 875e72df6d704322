#include "core/winding/packing/search.hpp"

#include <gtest/gtest.h>

#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

/// Seven circles of a third of the radius fit into a circle, one in the middle, and not eight (Graham 1968).
TEST(PackingSearch, SevenWiresFitAroundTheMiddleAndEightDoNot) {
  const double radius = 1.0 / 3 - 1e-3;
  const Region room = circle();
  const CentreArea centres(room, radius, silent);
  PackingSearch search(centres, 2 * radius, 5, silent);
  const auto found = search.find(7, {}, 200'000'000, 200);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->size(), 7u);
  expect_allowed(room, radius, 0, *found);
  EXPECT_FALSE(search.find(8, {}, 20'000'000, 20));
}

TEST(PackingSearch, HolesAreFilled) {
  const double radius = 0.24;
  const CentreArea centres(square(), radius, silent);
  PackingSearch search(centres, 2 * radius, 1, silent);
  std::vector<Point> wires{{0.25, 0.25}, {0.75, 0.75}};
  search.fill(wires);
  EXPECT_EQ(wires.size(), 4u);
  expect_allowed(square(), radius, 0, wires);
}

}  // namespace
}  // namespace bahnwerk::winding
