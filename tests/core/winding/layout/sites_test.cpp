#include "core/winding/layout/sites.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/winding/slot/slot.hpp"
#include "tests/core/geometry/region/random_region.hpp"
#include "tests/core/geometry/region/rooms.hpp"

namespace bahnwerk::winding {
namespace {

using test::polygon;
using test::random_region;
using test::rectangle;

std::vector<Point> fill(const Region& usable_area, double radius, Point tension_point) {
  Sites sites(usable_area, radius);
  while (const auto place = sites.nearest(tension_point)) sites.lay(*place);
  return {sites.wires().begin(), sites.wires().end()};
}

TEST(Sites, FirstWireInACornerTouchesBothWalls) {
  Sites sites(rectangle(10, 10), 1);
  const auto place = sites.nearest({-4, -4});
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 1, 1e-12);
  EXPECT_NEAR(place->y, 1, 1e-12);
}

TEST(Sites, ThePointItselfIfItIsFree) {
  Sites sites(rectangle(10, 10), 1);
  EXPECT_EQ(sites.nearest({4.25, 3}), (Point{4.25, 3}));
}

TEST(Sites, FootOnAWallIfThePointLiesBeyond) {
  Sites sites(rectangle(10, 10), 1);
  const auto place = sites.nearest({4.25, -3});
  ASSERT_TRUE(place);
  EXPECT_NEAR(distance(*place, {4.25, 1}), 0, 1e-12);
}

TEST(Sites, NearestPointOfACircleAroundAWireThatCoversThePoint) {
  Sites sites(rectangle(20, 20), 1);
  sites.lay({10, 10});
  const auto place = sites.nearest({10.6, 10.8});
  ASSERT_TRUE(place);
  EXPECT_NEAR(distance(*place, {11.2, 11.6}), 0, 1e-12);
}

TEST(Sites, PocketBetweenTwoWires) {
  Sites sites(rectangle(20, 20), 1);
  sites.lay({9, 1});
  sites.lay({11, 1});
  const auto place = sites.nearest({10, 1});
  ASSERT_TRUE(place);
  EXPECT_NEAR(distance(*place, {10, 1 + std::sqrt(3)}), 0, 1e-12);
}

TEST(Sites, EquallyNearPlacesGoByTheirX) {
  Sites sites(rectangle(20, 20), 1);
  sites.lay({10, 1});
  const auto place = sites.nearest({10, 1});
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x, 8, 1e-12);
}

TEST(Sites, NothingFits) {
  for (const Region& usable_area :
       {rectangle(10, 1.9), rectangle(1.9, 10), polygon({{0, 0}, {4, 0}, {2, 1}}), Region()}) {
    Sites sites(usable_area, 1);
    EXPECT_FALSE(sites.nearest({0, 0}));
    EXPECT_FALSE(sites.least({0, 1}));
    EXPECT_FALSE(sites.free({2, 0.5}));
  }
}

TEST(Sites, RoomThatOneWireFillsExactly) {
  const double inradius = 1;  // of the triangle 3-4-5
  for (const Region& usable_area :
       {rectangle(2, 2), Region({arc({3, 3}, 1, 0, 2 * std::numbers::pi)}), polygon({{0, 0}, {4, 0}, {0, 3}})})
    EXPECT_EQ(fill(usable_area, inradius, {-9, -9}).size(), 1u);
}

TEST(Sites, ChannelExactlyAsWideAsAWire) {
  const auto wires = fill(rectangle(2, 12.5), 1, {1, -9});
  ASSERT_EQ(wires.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(distance(wires[i], {1, 1 + 2.0 * static_cast<double>(i)}), 0, 1e-9);
}

TEST(Sites, RowThatFitsExactlyTakesItsLastWire) {
  // The gap between the wires laid first is a wire wide but for rounding.
  Sites sites(rectangle(6 * 1.217, 1.217), 0.6085);
  for (const int i : {0, 5, 2}) sites.lay({0.6085 + i * 1.217, 0.6085});
  std::size_t laid = 3;
  while (const auto place = sites.nearest({3, 9})) {
    sites.lay(*place);
    ++laid;
  }
  EXPECT_EQ(laid, 6u);
  EXPECT_TRUE(test::valid(rectangle(6 * 1.217, 1.217), 0.6085, {sites.wires().begin(), sites.wires().end()}));
}

TEST(Sites, LowestPlaceInAGrooveIsItsBottom) {
  // A half disc of radius 2 below the base holds a wire's centre on an arc of radius 1.
  const Region usable_area({line({-5, 0}, {-2, 0}), arc_between({0, 0}, {-2, 0}, {2, 0}, true), line({2, 0}, {5, 0}),
                            line({5, 0}, {5, 8}), line({5, 8}, {-5, 8}), line({-5, 8}, {-5, 0})});
  Sites sites(usable_area, 1);
  const auto place = sites.least({0, 1});
  ASSERT_TRUE(place);
  EXPECT_NEAR(distance(*place, {0, -1}), 0, 1e-12);
}

TEST(Sites, NoPlaceIsBetterAccordingToASample) {
  Random random(7);
  int queries = 0;
  for (int round = 0; round < 12; ++round) {
    const Region usable_area = random_region(random);
    const double radius = random.uniform(0.25, 0.8);
    Sites sites(usable_area, radius);
    std::vector<Point> wires;
    for (int i = 0; i < 12; ++i) {
      const Point p{random.uniform(-6, 6), random.uniform(-6, 6)};
      const double a = random.uniform(0, 6);
      const Point d{std::cos(a), std::sin(a)};
      const auto near = sites.nearest(p), low = sites.least(d);
      ASSERT_EQ(near.has_value(), low.has_value());
      const double least = test::sampled_least(usable_area, radius, wires, [&](Point q) { return distance(p, q); });
      if (!near) {
        EXPECT_EQ(least, std::numeric_limits<double>::infinity());
        break;
      }
      ++queries;
      EXPECT_TRUE(test::fits(usable_area, radius, wires, *near, 1e-9));
      EXPECT_LE(distance(*near, p), least + 1e-9);
      EXPECT_TRUE(test::fits(usable_area, radius, wires, *low, 1e-9));
      EXPECT_LE(dot(*low, d),
                test::sampled_least(usable_area, radius, wires, [&](Point q) { return dot(q, d); }) + 1e-9);
      const Point next = i % 3 ? *near : *low;
      sites.lay(next);
      wires.push_back(next);
    }
  }
  EXPECT_GT(queries, 60);
}

TEST(Sites, FullRoomHasNoPlaceLeftInASample) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    const Region usable_area = random_region(random);
    const auto wires = fill(usable_area, 0.5, {random.uniform(-9, 9), random.uniform(-9, 9)});
    EXPECT_TRUE(test::valid(usable_area, 0.5, wires));
    EXPECT_EQ(test::sampled_least(usable_area, 0.5, wires, [](Point) { return 0.0; }),
              std::numeric_limits<double>::infinity());
  }
}

TEST(Sites, DependsNotOnWherePartAndWireLie) {
  // Turned and moved together with its attraction point, a filling turns and moves.
  const Region usable_area = make_slot(StatorSlot{}).usable_area;
  const double a = 0.7;
  const auto moved = [&](Point p) {
    return Point{3 + std::cos(a) * p.x - std::sin(a) * p.y, -8 + std::sin(a) * p.x + std::cos(a) * p.y};
  };
  std::vector<Edge> edges(usable_area.edges().begin(), usable_area.edges().end());
  for (Edge& edge : edges) {
    edge.from = moved(edge.from);
    edge.to = moved(edge.to);
    edge.centre = moved(edge.centre);
  }
  const Point tension_point{-2.5, -4.7};
  const auto still = fill(usable_area, 0.4945, tension_point),
             turned = fill(Region(edges), 0.4945, moved(tension_point));
  ASSERT_EQ(still.size(), turned.size());
  for (std::size_t i = 0; i < still.size(); ++i) EXPECT_NEAR(distance(moved(still[i]), turned[i]), 0, 1e-6);
}

}  // namespace
}  // namespace bahnwerk::winding
