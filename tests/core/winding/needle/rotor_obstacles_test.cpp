#include "core/winding/needle/rotor_obstacles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/errors.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;

RotorIron iron(const RotorPart& part, const RotorShape& shape = {}) {
  return RotorIron(part, checked_slot(part), shape);
}

/// Ends of the flanks at the shoe and at the root, from Table 4.2: slot coordinates.
struct Ends {
  Point shoe, root;
  explicit Ends(const RotorSlot& s) {
    const double lean = pi - s.shoe_angle;  // of the shoe's flank against the tooth
    const Point along{std::cos(lean), std::sin(lean)};
    const Point foot = Point{s.base_width, s.shoe_radius} + s.shoe_radius * Point{along.y, -along.x};
    shoe = foot + s.shoe_flank * along;
    root = s.root_flank * Point{std::cos(s.root_angle), std::sin(s.root_angle)};
  }
};

TEST(RotorIron, HasTheSlotsOutlineOnBothSidesOfEveryPole) {
  const RotorPart part;
  const RotorIron rotor = iron(part);
  const Slot slot = checked_slot(part);
  Random random(2);
  int near = 0;
  for (int i = 0; i < 4000; ++i) {
    const Point p{random.uniform(-1, 14), random.uniform(-2, 1)};
    const double depth = slot.iron.distance(p);
    if (std::abs(depth) > 1) continue;  // where nothing but base and flanks is near
    ++near;
    for (int pole = 0; pole < part.poles; ++pole)
      for (const double side : {-1.0, 1.0}) {
        const Vec3 at = turned({40.10 + p.x, side * (10.35 + p.y), 100}, pole * part.pitch());
        EXPECT_NEAR(rotor.distance(at), depth, 1e-9);
        EXPECT_NEAR(rotor.section_distance(at), depth, 1e-9);
      }
  }
  EXPECT_GT(near, 1000);
}

TEST(RotorIron, ShoesHubAndEndCaps) {
  const RotorPart part;
  const Ends ends(part.slot);
  const RotorIron rotor = iron(part);
  const double outer = std::hypot(40.10 + ends.shoe.x, 10.35 + ends.shoe.y),
               hub = std::hypot(40.10 + ends.root.x, 10.35 + ends.root.y), middle = part.pitch() / 2;
  for (int pole = 0; pole < part.poles; ++pole) {
    const double at = pole * part.pitch();
    EXPECT_NEAR(rotor.distance((outer + 3) * radial(at) + Vec3{0, 0, 50}), 3, 1e-9) << "above the shoe";
    EXPECT_NEAR(rotor.distance((outer - 3) * radial(at) + Vec3{0, 0, 50}), -3, 1e-9);
    EXPECT_NEAR(rotor.distance((hub + 2) * radial(at + middle) + Vec3{0, 0, 50}), 2, 1e-9) << "between the poles";
    EXPECT_NEAR(rotor.distance((hub - 2) * radial(at + middle) + Vec3{0, 0, 50}), -2, 1e-9);
    // In the opening, off the shoe's corner.
    const Vec3 corner = turned({40.10 + ends.shoe.x, 10.35 + ends.shoe.y, 50}, at);
    EXPECT_NEAR(rotor.distance(turned(corner, 0.2)), 2 * outer * std::sin(0.1), 1e-9);
    // The end caps continue the stack up to the grooves.
    EXPECT_NEAR(rotor.distance((outer - 5) * radial(at) + Vec3{0, 0, 202 + 10.6 + 2}), 2, 1e-9);
    EXPECT_NEAR(rotor.distance((outer - 5) * radial(at) + Vec3{0, 0, -10.6 - 4}), 4, 1e-9);
    EXPECT_NEAR(rotor.distance((outer - 5) * radial(at) + Vec3{0, 0, -10.6 + 1}), -1, 1e-9);
    EXPECT_NEAR(rotor.distance((outer + 3) * radial(at) + Vec3{0, 0, -10.6 - 4}), 5, 1e-9) << "off an edge";
  }
  // An edge of the shoe adds to its radius.
  const RotorIron thick = iron(part, {.shoe_edge = 1.5});
  EXPECT_NEAR(thick.distance((outer + 3) * radial(0) + Vec3{0, 0, 50}), 1.5, 1e-9);
  const Point side = (1 / outer) * Point{40.10 + ends.shoe.x, 10.35 + ends.shoe.y};
  const Point beside = (outer + 0.75) * side + 0.5 * left_of(side);
  EXPECT_NEAR(thick.distance({beside.x, beside.y, 50}), 0.5, 1e-9) << "its face lies along the radius";
}

TEST(RotorIron, ChangesByNoMoreThanThePointMoves) {
  Random random(6);
  for (const int poles : {2, 4, 6}) {
    RotorPart part;
    part.poles = poles;
    const RotorIron rotor = iron(part, {.shoe_edge = 1});
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 p = random.uniform(0, 70) * radial(random.uniform(-pi, pi)) + Vec3{0, 0, random.uniform(-20, 220)};
      const Vec3 q = p + Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const double a = rotor.distance(p), b = rotor.distance(q);
      EXPECT_LE(std::abs(a - b), norm(p - q) + 1e-9);
      EXPECT_LE(rotor.section_distance(p), a + 1e-12);
      EXPECT_NEAR(rotor.distance(turned(p, part.pitch())), a, 1e-9) << "every pole alike";
      EXPECT_NEAR(rotor.distance({p.x, -p.y, p.z}), a, 1e-9) << "poles are symmetric";
      inside += a < 0;
    }
    EXPECT_GT(inside, 1000);
  }
}

TEST(RotorIron, WithOneSlotTheOthersAreIron) {
  Random random(46);
  const RotorPart part;
  const RotorIron rotor = iron(part);
  const double pitch = part.pitch(), outer = outer_radius(part, checked_slot(part));
  for (const int n : {0, 1, 5}) {
    const double slot = slot_azimuth(part, n);
    const OneSlot own(rotor, slot);
    for (int i = 0; i < 2000; ++i) {
      const double aside = random.uniform(-pi, pi);
      const Vec3 p = random.uniform(20, outer - 0.5) * radial(slot + aside) + Vec3{0, 0, random.uniform(-20, 230)};
      if (std::abs(aside) <= pitch / 2) {
        EXPECT_NEAR(own.distance(p), rotor.distance(p), 1e-12);
      } else {
        EXPECT_LT(own.section_distance(p), 0) << aside;
      }
    }
  }
}

TEST(RotorIron, EndCapsFitTheLayingRegions) {
  const RotorPart part;
  const Slot slot = checked_slot(part);
  const RotorShape shape{.shoe_edge = 0, .outer_wall = 17.4, .wall_overhang = 0};
  const RotorIron rotor(part, slot, shape);
  const std::vector<Wall> walls = cap_walls(part, slot, shape);
  ASSERT_EQ(walls.size(), 2u * 2 * 6);
  // Wires on the cap's section touch the walls where its flanks say so.
  for (int pole = 0; pole < part.poles; ++pole) {
    const LayingRegions regions = coil_regions(part, slot, {pole, 1});
    for (const std::size_t j : {1u, 3u}) {
      const LayingRegion& head = regions.at[j];
      const auto edges = head.usable_area.edges();
      for (const Edge& flank : edges) {
        if (!flank.straight() || std::abs(flank.direction(0).y) < 0.5) continue;
        for (const double at : {0.3, 0.6, 0.9}) {
          const Point on = flank.at(at);
          if (on.y < 1) continue;  // grooves and the shoe's rounding
          const Vec3 p = 0.5 * (head.begin.place(on) + head.end.place(on)),
                     off = 0.5 * (head.begin.place(on + 0.4 * left_of(flank.direction(0))) +
                                  head.end.place(on + 0.4 * left_of(flank.direction(0))));
          double touching = 1e9, away = 1e9;
          for (const Wall& wall : walls) {
            touching = std::min(touching, wall.distance(p));
            away = std::min(away, wall.distance(off));
          }
          EXPECT_NEAR(touching, 0, 1e-9);
          EXPECT_NEAR(away, 0.4, 1e-9);
        }
      }
    }
  }
}

TEST(Wall, DistanceInClosedForm) {
  // A triangle over x from 10 to 14 and height 0 to 3, 4 mm wide, at the azimuth of y.
  const Wall wall(pi / 2, Region({line({10, 0}, {14, 0}), line({14, 0}, {10, 3}), line({10, 3}, {10, 0})}), 2);
  EXPECT_NEAR(wall.distance({0, 8, 1}), 2, 1e-12);
  EXPECT_NEAR(wall.distance({5, 8, 1}), std::hypot(2, 3), 1e-12);
  EXPECT_NEAR(wall.distance({0, 14, 3}), 12 / 5.0, 1e-12) << "off the sloping face";
  EXPECT_NEAR(wall.distance({-6, 11, 1}), 4, 1e-12);
  EXPECT_NEAR(wall.distance({1.5, 11, 1}), -0.5, 1e-12);
  EXPECT_NEAR(wall.distance({0, 11, 0.25}), -0.25, 1e-12);
  // Convex along every line.
  Random random(3);
  const auto any = [&] { return Vec3{random.uniform(-8, 8), random.uniform(4, 20), random.uniform(-6, 9)}; };
  for (int i = 0; i < 5000; ++i) {
    const Vec3 a = any(), b = any();
    const double t = random.uniform(0, 1);
    EXPECT_LE(wall.distance(a + t * (b - a)), (1 - t) * wall.distance(a) + t * wall.distance(b) + 1e-9);
    const Vec3 n = wall.away(a);
    EXPECT_NEAR(norm(n), 1, 1e-12);
    EXPECT_GE(wall.distance(b), wall.distance(a) + dot(n, b - a) - 1e-9) << "behind the plane at its nearest point";
  }
}

TEST(RotorObstacles, ImpossibleOnesAreRefused) {
  const RotorPart part;
  const Slot slot = checked_slot(part);
  const auto refused = [&](const RotorShape& shape) -> std::string {
    std::string all;
    try {
      RotorIron(part, slot, shape);
      cap_walls(part, slot, shape);
    } catch (const InvalidInput& e) {
      for (const InputFault& f : e.faults) all += f.place.at(0) + "." + f.place.at(1) + " ";
    }
    return all;
  };
  EXPECT_EQ(refused({}), "");
  EXPECT_EQ(refused({.shoe_edge = -1}), "rotor.shoe_edge ");
  EXPECT_EQ(refused({.outer_wall = std::numeric_limits<double>::infinity(), .wall_overhang = -1}),
            "rotor.outer_wall rotor.wall_overhang ");
  EXPECT_EQ(refused({.outer_wall = 18}), "rotor.outer_wall ");
  EXPECT_THROW(RotorIron(part, make_slot(StatorSlot{})), std::invalid_argument);
}

// Walls that lean so far that they would pass the axis end there; upright ones and ones that overhang have their place.
TEST(RotorObstacles, WallsOfAnyLean) {
  for (const double angle : {80.0, 90.0, 100.0, 150.0, 170.0}) {
    RotorPart part;
    part.slot.root_angle = angle * pi / 180;
    part.slot.root_flank = 2;
    part.heads.cap_height = 24;
    const Slot slot = checked_slot(part);
    const std::vector<Wall> walls = cap_walls(part, slot);
    ASSERT_EQ(walls.size(), 12u);
    const double x = std::max(0.0, 40.10 + 1 / std::tan(part.slot.root_angle));
    EXPECT_NEAR(walls[1].distance({x, 0, 202 + 10.6 + 1}), 0, 1e-9) << angle;
    EXPECT_NEAR(walls[0].distance({x, 0, -10.6 - 1}), 0, 1e-9) << angle;
    EXPECT_LT(walls[0].distance({x - 0.1, 0, -10.6 - 0.9}), 0) << angle;
  }
}

}  // namespace
}  // namespace bahnwerk::winding
