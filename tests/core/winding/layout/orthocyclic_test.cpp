#include "core/winding/layout/orthocyclic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/winding/slot/slot.hpp"
#include "tests/core/geometry/region/random_region.hpp"
#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk::winding {
namespace {

using test::rectangle;

Progress silent;

/// All points of the lattice through `first` that keep their distance, by trying far more than can.
std::size_t lattice_points(const Region& usable_area, double radius, Point first, double angle) {
  const Point a = 2 * radius * Point{std::cos(angle), std::sin(angle)};
  const Point b = 2 * radius * Point{std::cos(angle + std::numbers::pi / 3), std::sin(angle + std::numbers::pi / 3)};
  std::size_t count = 0;
  for (int i = -120; i <= 120; ++i)
    for (int j = -120; j <= 120; ++j)
      count += usable_area.distance(first + static_cast<double>(i) * a + static_cast<double>(j) * b) >= radius - 1e-9;
  return count;
}

TEST(Orthocyclic, RowsOfARectangleAlternate) {
  // 5 and 4 wires in turn; rows rise by √3 r.
  const Layout layout = orthocyclic(rectangle(10, 2 + 6 * std::sqrt(3)), 1, {-4, -4}, 0, silent);
  ASSERT_EQ(layout.wires.size(), 4u * 5 + 3 * 4);
  EXPECT_NEAR(distance(layout.wires[4], {9, 1}), 0, 1e-12);
  EXPECT_NEAR(distance(layout.wires[5], {2, 1 + std::sqrt(3)}), 0, 1e-12);
  EXPECT_TRUE(test::valid(rectangle(10, 2 + 6 * std::sqrt(3)), 1, layout.wires));
}

TEST(Orthocyclic, NothingFitsAndOneWireFits) {
  EXPECT_TRUE(orthocyclic(rectangle(10, 1.9), 1, {0, 0}, 0, silent).wires.empty());
  EXPECT_EQ(orthocyclic(rectangle(2.5, 2.5), 1, {0, 0}, 0.3, silent).wires.size(), 1u);
}

TEST(Orthocyclic, RowsContinueBeyondAGap) {
  // A tooth from below parts the first row and cuts the second.
  const Region usable_area = test::polygon({{0, 0}, {8, 0}, {9, 3}, {10, 0}, {20, 0}, {20, 7}, {0, 7}});
  const Layout layout = orthocyclic(usable_area, 1, {-4, -4}, 0, silent);
  bool left = false, right = false;
  for (const Point p : layout.wires) {
    if (p.y < 1.5 && p.x < 8) left = true;
    if (p.y < 1.5 && p.x > 10) right = true;
  }
  EXPECT_TRUE(left && right);
}

TEST(Orthocyclic, RowsOnBothSidesOfTheFirst) {
  // Drawn to the middle of the usable area, the first wire lies there.
  const Layout layout = orthocyclic(rectangle(12, 12), 1, {6, 6}, 0, silent);
  EXPECT_EQ(layout.wires.size(), lattice_points(rectangle(12, 12), 1, {6, 6}, 0));
  EXPECT_GT(layout.wires.size(), 20u);
  double last = 0;
  for (const Point p : layout.wires) {
    EXPECT_GE(std::abs(p.y - 6), last - 1e-9);  // rows by their distance
    last = std::abs(p.y - 6);
  }
}

TEST(Orthocyclic, EveryLatticePointOfRandomRooms) {
  Random random(5);
  for (int round = 0; round < 40; ++round) {
    const Region usable_area = test::random_region(random);
    const double radius = random.uniform(0.15, 0.9), angle = random.uniform(-3, 3);
    const Layout layout =
        orthocyclic(usable_area, radius, {random.uniform(-9, 9), random.uniform(-9, 9)}, angle, silent);
    EXPECT_TRUE(test::valid(usable_area, radius, layout.wires));
    if (!layout.wires.empty()) {
      EXPECT_EQ(layout.wires.size(), lattice_points(usable_area, radius, layout.wires[0], angle));
    }
  }
}

TEST(Orthocyclic, WiresOfARowGrowAwayFromTheFirst) {
  const Layout layout = orthocyclic(rectangle(15, 4), 1, {7.3, -4}, 0, silent);
  double last = 0;
  for (std::size_t i = 1; i < layout.wires.size() && layout.wires[i].y < 1.5; ++i) {
    const double away = std::abs(layout.wires[i].x - layout.wires[0].x);
    EXPECT_GE(away, last - 1e-9);
    last = away;
  }
  EXPECT_GT(last, 4);
}

TEST(Orthocyclic, RotorsGroovesHoldTheFirstRow) {
  const Slot slot = make_slot(RotorSlot{});
  const Layout layout = orthocyclic(slot.usable_area, 0.6085, slot.tension_point, 0, silent);
  std::size_t row = 0;
  while (row < layout.wires.size() && std::abs(layout.wires[row].y - layout.wires[0].y) < 1e-9) ++row;
  EXPECT_EQ(row, 12u);
  EXPECT_TRUE(test::valid(slot.usable_area, 0.6085, layout.wires));
}

}  // namespace
}  // namespace bahnwerk::winding
