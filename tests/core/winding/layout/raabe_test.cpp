#include "core/winding/layout/raabe.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/wire.hpp"
#include "tests/core/geometry/region/random_region.hpp"
#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk::winding {
namespace {

using test::rectangle;

Progress silent;

TEST(Raabe, FlatBaseFillsFromTheLeft) {
  const Layout layout = raabe(rectangle(10, 2 + 2 * std::sqrt(3)), 1, silent);
  ASSERT_EQ(layout.wires.size(), 5u + 4 + 5);
  EXPECT_NEAR(distance(layout.wires[0], {1, 1}), 0, 1e-9);
  EXPECT_NEAR(distance(layout.wires[1], {3, 1}), 0, 1e-9);
  EXPECT_NEAR(distance(layout.wires[5], {2, 1 + std::sqrt(3)}), 0, 1e-9);
  EXPECT_NEAR(distance(layout.wires[9], {1, 1 + 2 * std::sqrt(3)}), 0, 1e-9);
}

TEST(Raabe, RoomsThatLayersFillExactly) {
  Random random(21);
  for (int round = 0; round < 40; ++round) {
    const double r = random.uniform(0.2, 1.5);
    const std::size_t k = 2 + random.below(9), layers = 1 + random.below(6);
    const Region usable_area =
        rectangle(2 * r * static_cast<double>(k), 2 * r + static_cast<double>(layers - 1) * std::sqrt(3) * r);
    const Layout layout = raabe(usable_area, r, silent, 1);
    EXPECT_EQ(layout.wires.size(), layers * k - layers / 2);
    EXPECT_TRUE(test::valid(usable_area, r, layout.wires));
  }
}

TEST(Raabe, NothingFitsAndOneWireFits) {
  EXPECT_TRUE(raabe(rectangle(10, 1.9), 1, silent).wires.empty());
  EXPECT_EQ(raabe(rectangle(2, 2), 1, silent).wires.size(), 1u);
}

TEST(Raabe, EveryWireTakesTheLowestPlace) {
  Random random(11);
  for (int round = 0; round < 6; ++round) {
    const Region usable_area = test::random_region(random);
    const Layout layout = raabe(usable_area, 0.55, silent, 1);
    EXPECT_TRUE(test::valid(usable_area, 0.55, layout.wires));
    std::vector<Point> laid;
    for (const Point p : layout.wires) {
      EXPECT_LE(p.y, test::sampled_least(usable_area, 0.55, laid, [](Point q) { return q.y; }) + 1e-9);
      laid.push_back(p);
    }
    EXPECT_EQ(test::sampled_least(usable_area, 0.55, laid, [](Point q) { return q.y; }),
              std::numeric_limits<double>::infinity());
  }
}

TEST(Raabe, StartsMoveByFractionsOfTheRadiusAndTheBestIsKept) {
  const Region usable_area = make_slot(StatorSlot{}).usable_area;
  int better = 0;
  for (const Wire& wire : standard_wires(2, 0.5, 1.6, Series::r40)) {
    const double r = wire.radius();
    const Layout one = raabe(usable_area, r, silent, 1), four = raabe(usable_area, r, silent, 4);
    EXPECT_TRUE(test::valid(usable_area, r, four.wires));
    // The first wire starts at the left or at the right lowest place, which mirror each other.
    const double left = (four.wires[0].x - one.wires[0].x) / (r / 4),
                 right = -(four.wires[0].x + one.wires[0].x) / (r / 4),
                 steps = std::abs(left - std::round(left)) < 1e-6 && left > -1e-6 && left < 3 + 1e-6 ? left : right;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
    EXPECT_GE(steps, -1e-6);
    EXPECT_LE(steps, 3 + 1e-6);
    // On the base: touching it from above.
    EXPECT_NEAR(usable_area.distance(four.wires[0]), r, 1e-9);
    EXPECT_LT(four.wires[0].y, one.wires[0].y + 0.01);
    EXPECT_GE(four.wires.size(), one.wires.size());
    better += four.wires.size() > one.wires.size();
  }
  EXPECT_GT(better, 0);
}

TEST(Raabe, AMirroredSlotTakesEquallyManyWires) {
  Random random(5);
  for (int round = 0; round < 60; ++round) {
    PolygonSlot slot;
    const int corners = 5 + static_cast<int>(random.below(5));
    for (int k = 0; k < corners; ++k) {
      const double angle = (k + random.uniform(0.1, 0.9)) * 2 * std::numbers::pi / corners;
      slot.points.push_back(random.uniform(8, 14) * Point{std::cos(angle), std::sin(angle)});
    }
    PolygonSlot mirrored = slot;
    for (Point& p : mirrored.points) p.x = -p.x;
    const double r = random.uniform(0.6, 2);
    EXPECT_EQ(raabe(make_slot(slot).usable_area, r, silent, 2).wires.size(),
              raabe(make_slot(mirrored).usable_area, r, silent, 2).wires.size());
  }
}

TEST(Raabe, ShiftedStartDropsToTheBase) {
  // 3.9 wide: one wire at the lowest place leaves no usable area beside it, whatever the shift.
  const Layout layout = raabe(rectangle(3.9, 2.2), 1, silent);
  ASSERT_EQ(layout.wires.size(), 1u);
  EXPECT_NEAR(distance(layout.wires[0], {1, 1}), 0, 1e-9);
}

}  // namespace
}  // namespace bahnwerk::winding
