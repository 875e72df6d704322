#include "core/winding/needle/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numeric/random.hpp"
#include "core/winding/needle/part_obstacles.hpp"

namespace bahnwerk::winding {
namespace {

bool holds(const std::vector<Point>& loop, Point p) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point a = loop[i], b = loop[(i + 1) % loop.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

bool holds(const Solid& solid, Vec3 p) {
  const Vec3 way = p - solid.origin;
  const Point at{dot(way, solid.x), dot(way, solid.y)};
  const double height = dot(way, solid.z);
  if (height <= solid.from || height >= solid.to) return false;
  if (!solid.outline.empty() && !holds(solid.outline, at)) return false;
  return std::none_of(solid.holes.begin(), solid.holes.end(), [&](const auto& hole) { return holds(hole, at); });
}

double area(const std::vector<Point>& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) sum += cross(loop[i], loop[(i + 1) % loop.size()]);
  return sum / 2;
}

// Where a point is farther from the surface than the chords from the arcs, prism and distance agree on its side.
void expect_solids_are_obstacles(const PartObstacles& all, double size, double low, double high) {
  constexpr double tolerance = 0.05;
  Random random(3);
  int inside = 0;
  for (std::size_t i = 0; i < all.list().size(); ++i) {
    const Solid solid = all.list()[i]->solid(tolerance);
    EXPECT_NEAR(norm(cross(solid.x, solid.y) - solid.z), 0, 1e-12);
    if (!solid.outline.empty()) {
      EXPECT_GT(area(solid.outline), 0) << all.name(i);
    }
    for (const auto& hole : solid.holes) EXPECT_LT(area(hole), 0) << all.name(i);
    for (int n = 0; n < 2000; ++n) {
      // Around the obstacle, so that small ones are hit.
      Vec3 p{random.uniform(-size, size), random.uniform(-size, size), random.uniform(low, high)};
      if (!solid.outline.empty() && n % 2 == 0) {
        const Point& corner = solid.outline[static_cast<std::size_t>(n) % solid.outline.size()];
        p = solid.origin + corner.x * solid.x + corner.y * solid.y + random.uniform(solid.from, solid.to) * solid.z +
            Vec3{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
      }
      const double distance = all.list()[i]->distance(p);
      if (std::abs(distance) <= tolerance) continue;
      ASSERT_EQ(holds(solid, p), distance < 0) << all.name(i) << " " << p.x << " " << p.y << " " << p.z;
      inside += distance < 0;
    }
  }
  EXPECT_GT(inside, 100);
}

TEST(Solid, IsTheStacksAndTheToolsObstacle) {
  for (const int slots : {12, 48}) {
    StatorPart part;
    part.slots = slots;
    expect_solids_are_obstacles(part_obstacles(part, checked_slot(part), {}, {{0, 5}, {3, -5}}), 110, -30, 240);
  }
}

TEST(Solid, IsThePolesAndTheCapsObstacle) {
  for (const int poles : {2, 6}) {
    RotorPart part;
    part.poles = poles;
    expect_solids_are_obstacles(part_obstacles(part, checked_slot(part), {.shoe_edge = 1, .outer_wall = 3}), 70, -35,
                                235);
  }
}

TEST(Solid, ChordsKeepTheTolerance) {
  for (const double tolerance : {0.5, 0.01}) {
    std::vector<Point> line{{10, 0}};
    append_chords(arc({0, 0}, 10, 0, 3), tolerance, line);
    EXPECT_NEAR(norm(line.back() - 10.0 * Point{std::cos(3), std::sin(3)}), 0, 1e-12);
    for (std::size_t i = 1; i < line.size(); ++i)
      EXPECT_LE(10 - norm(0.5 * (line[i] + line[i - 1])), tolerance * (1 + 1e-9));
  }
}

TEST(Solid, CopiesAreJoinedByArcs) {
  const std::vector<Point> line{{10, -1}, {8, 0}, {10, 1}};
  const std::vector<Point> round = closed_round(line, 4, std::numbers::pi / 2, 0.1);
  double least = HUGE_VAL;
  for (const Point p : round) least = std::min(least, norm(p));
  EXPECT_EQ(least, 8);
  EXPECT_NEAR(area(round), std::numbers::pi * norm(line[0]) * norm(line[0]), 30);
}

}  // namespace
}  // namespace bahnwerk::winding
