// Rooms that wires fill exactly: lines and points are all that is left for their centres.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numeric/random.hpp"
#include "core/winding/centre_borders.hpp"
#include "core/winding/layout/count_bound.hpp"
#include "core/winding/layout/orthocyclic.hpp"
#include "core/winding/layout/potential.hpp"
#include "core/winding/layout/raabe.hpp"
#include "core/winding/margin.hpp"
#include "tests/core/winding/layout/drawn_to.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

std::vector<Point> turned(std::vector<Point> corners, double angle, Point by) {
  for (Point& p : corners)
    p = by + Point{std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
  return corners;
}
std::vector<Point> box(double width, double height) { return {{0, 0}, {width, 0}, {width, height}, {0, height}}; }
/// About the circle of radius 0.5.
std::vector<Point> around(int sides) {
  std::vector<Point> corners;
  for (int k = 0; k < sides; ++k) {
    const double a = 2 * std::numbers::pi * k / sides;
    corners.push_back(0.5 / std::cos(std::numbers::pi / sides) * Point{std::cos(a), std::sin(a)});
  }
  return corners;
}

constexpr double angles[] = {0, 0.302, 0.5777, std::numbers::pi / 4, 1.2514};
constexpr Point places[] = {{0, 0}, {9000, -9000}};

/// Rows of wires along the first side of a usable area: all that are laid, by every algorithm.
void expect_count(const Region& usable_area, double angle, std::size_t count, const std::string& what) {
  EXPECT_EQ(max_wires(usable_area, 0.5, 1), count) << what;
  const Point tension_point = usable_area.edges()[0].from - 5.0 * usable_area.edges()[0].direction(0);
  EXPECT_EQ(orthocyclic(usable_area, 0.5, tension_point, angle, silent).wires.size(), count) << what;
  EXPECT_EQ(raabe(usable_area, 0.5, silent).wires.size(), count) << what;
  EXPECT_EQ(test::drawn_to(usable_area, 0.5, tension_point).size(), count) << what;
  const auto most = potential(usable_area, 0.5, {}, {}, silent);
  EXPECT_EQ(most.size(), count) << what;
  expect_allowed(usable_area, 0.5, 0, most);
}

TEST(ExactFit, RowIsFilledByAllAlgorithms) {
  for (const int count : {1, 2, 7, 12})
    for (const double angle : angles)
      for (const Point place : places)
        expect_count(polygon(turned(box(count, 1), angle, place)), angle, static_cast<std::size_t>(count),
                     std::to_string(count) + " wires, " + std::to_string(angle) + " rad");
}

TEST(ExactFit, FourWiresFitInASquare) {
  for (const double angle : angles)
    for (const Point place : places) {
      const Region usable_area = polygon(turned(box(2, 2), angle, place));
      EXPECT_EQ(max_wires(usable_area, 0.5, 1), 4u);
      EXPECT_EQ(potential(usable_area, 0.5, {}, {}, silent).size(), 4u);
      EXPECT_LE(orthocyclic(usable_area, 0.5, place, angle, silent).wires.size(), 3u)
          << "no lattice of triangles has a square";
    }
}

TEST(ExactFit, InscribedCircleFits) {
  for (const int sides : {3, 4, 6, 7, 50})
    for (const double angle : angles)
      expect_count(polygon(turned(around(sides), angle, {31, 7})), 0.1, 1, std::to_string(sides) + " sides");
  expect_count(Region({arc({3, 4}, 0.5, 0, 2 * std::numbers::pi)}), 0, 1, "a circle");
}

// Rooms with a corridor of 4 × 1 mm: its line is part of where centres may lie, beside areas.
const std::vector<Point> corridor{{0, 0}, {2, 0}, {2, 0.5}, {6, 0.5}, {6, 1.5}, {2, 1.5}, {2, 2}, {0, 2}};
/// Its walls do not begin beside each other.
const std::vector<Point> staggered{{0, 0}, {2, 0}, {2, 0.5}, {6, 0.5}, {6.5, 1.5}, {3, 1.5}, {3, 2}, {0, 2}};
const std::vector<Point> between_rooms{{0, 0}, {2, 0}, {2, 0.5}, {6, 0.5}, {6, 0}, {8, 0},
                                       {8, 2}, {6, 2}, {6, 1.5}, {2, 1.5}, {2, 2}, {0, 2}};

TEST(ExactFit, CorridorBesideARoomIsFilled) {
  const std::pair<std::vector<Point>, std::size_t> usable_areas[] = {
      {corridor, 8}, {staggered, 8}, {between_rooms, 12}};
  for (const auto& [corners, count] : usable_areas)
    for (const double angle : angles)
      for (const Point place : {Point{100, 200}, places[1]}) {
        const Region usable_area = polygon(turned(corners, angle, place));
        EXPECT_GE(max_wires(usable_area, 0.5, 1), count);
        const auto wires = potential(usable_area, 0.5, {}, {}, silent);
        EXPECT_GE(wires.size(), count) << angle;
        expect_allowed(usable_area, 0.5, 0, wires);
      }
  EXPECT_EQ(potential(polygon(corridor), 0.5, {}, {}, silent).size(), 8u);
}

TEST(ExactFit, LinesAreNoAreas) {
  for (const auto& corners : {corridor, staggered, between_rooms, box(7, 1), box(1, 1)})
    for (const double angle : angles)
      for (const Point place : places) {
        const Region usable_area = polygon(turned(corners, angle, place)), centres = usable_area.inward(0.5);
        double length = 0;
        for (const Edge& edge : centres.edges()) {
          const Point inside = edge.at(0.5) + 1e-6 * left_of(edge.direction(0.5));
          EXPECT_GT(usable_area.distance(inside), 0.5 + 1e-7) << angle;
          length += edge.length();
        }
        if (corners.size() == 4) {
          EXPECT_EQ(length, 0) << angle;
        }
        // The tip of a cusp between arcs of 0.5 mm is known to √(2 · 0.5 mm · fit_margin) = 2.2e-5 mm.
        double lines = 0;
        for (const Edge& piece : exact_fits(centre_borders(usable_area, 0.5), centres).pieces) lines += piece.length();
        if (corners == corridor) {
          EXPECT_NEAR(lines, 2 * 3.5, 1e-4) << angle;
        } else if (corners == between_rooms) {
          EXPECT_NEAR(lines, 2 * 4, 1e-4) << angle;
        }
      }
}

TEST(ExactFit, AMillionthTooLargeDoesNotFit) {
  const double radius = 0.5 * (1 + 1e-6);
  for (const double angle : angles)
    for (const Point place : places) {
      for (const int sides : {3, 4, 6, 7}) {
        const Region usable_area = polygon(turned(around(sides), angle, place));
        EXPECT_EQ(max_wires(usable_area, radius, 2 * radius), 0u) << sides;
        EXPECT_TRUE(raabe(usable_area, radius, silent).wires.empty());
        EXPECT_TRUE(test::drawn_to(usable_area, radius, {0, 0}).empty());
        EXPECT_TRUE(orthocyclic(usable_area, radius, {0, 0}, angle, silent).wires.empty());
        EXPECT_TRUE(potential(usable_area, radius, {}, {}, silent).empty());
      }
      const Region row = polygon(turned(box(7, 1 + 1e-5), angle, place));
      EXPECT_EQ(test::drawn_to(row, radius, row.edges()[0].from).size(), 6u);
    }
}

// The distance of a place that touches is known to fit_margin, for all sizes that a document may have: against long
// double.
TEST(ExactFit, RoundingStaysBelowTheMargin) {
  Random random(5);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const Point a{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)},
        b{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)};
    const Edge side = line(a, b);
    const double radius = random.uniform(0.05, 50), f = random.uniform(0.01, 0.99);
    const Point p = Edge(line(a + radius * left_of(side.direction(0)), b + radius * left_of(side.direction(0)))).at(f);
    const long double dx = static_cast<long double>(b.x) - a.x, dy = static_cast<long double>(b.y) - a.y;
    const long double exact =
        (dx * (static_cast<long double>(p.y) - a.y) - dy * (static_cast<long double>(p.x) - a.x)) /
        std::sqrt(dx * dx + dy * dy);
    const double known = distance(side.at(side.nearest(p)), p);
    worst = std::max({worst, std::abs(known - static_cast<double>(exact)), std::abs(known - radius)});
    // The base of a stator: an arc of up to 1e5 mm radius.
    const double large = random.uniform(10, 1e5), turn = random.uniform(0.1, 0.9);
    const Edge base = arc({0, large}, large, -std::numbers::pi / 2 - 40 / large, 80 / large);
    const Edge inner = arc({0, large}, large - radius, -std::numbers::pi / 2 - 40 / large, 80 / large);
    const Point q = inner.at(turn);
    worst = std::max(worst, std::abs(distance(base.at(base.nearest(q)), q) - radius));
  }
  EXPECT_LT(worst, fit_margin);
  EXPECT_GT(worst, 1e-13) << "or nothing was measured";
}

TEST(ExactFit, LeavesLinesAndPoints) {
  const Region usable_area = rectangle(7, 1);
  const CentreBorders left = exact_fits(centre_borders(usable_area, 0.5), usable_area.inward(0.5));
  ASSERT_EQ(left.pieces.size(), 2u) << "from either wall";
  EXPECT_NEAR(left.pieces[0].length(), 6, 1e-12);
  const Region square = rectangle(1, 1);
  EXPECT_TRUE(exact_fits(centre_borders(square, 0.5), square.inward(0.5)).pieces.empty());
  EXPECT_FALSE(centre_borders(square, 0.5).corners.empty());
  const Region wide = rectangle(7, 3);
  const CentreBorders none = exact_fits(centre_borders(wide, 0.5), wide.inward(0.5));
  EXPECT_TRUE(none.pieces.empty() && none.corners.empty());
}

}  // namespace
}  // namespace bahnwerk::winding
