#include "core/winding/slot/slot.hpp"

#include <gmock/gmock.h>

#include <array>
#include <numbers>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {
namespace {

/// The member that a slot is refused for, "" if it is accepted.
template <class Slot>
std::string refused(const Slot& slot) {
  try {
    make_slot(slot);
  } catch (const InvalidInput& error) {
    return error.faults.front().place.back();
  }
  return {};
}

// 83.0 and 73.2 mm²: areas that fit [Herrmann]'s figures, see docs/methods/fill_factor.md.
TEST(StatorSlotTest, ExampleHasTheSourcesAreas) {
  const Slot slot = make_slot(StatorSlot{});
  EXPECT_NEAR(slot.iron.area(), 83.0, 0.05);
  EXPECT_NEAR(slot.usable_area.area(), 73.2, 0.05);
  EXPECT_NEAR(slot.iron.box().high.y, 16.129, 1e-12);
  EXPECT_NEAR(slot.iron.distance({0, 8}), 2.577, 0.01);
}

TEST(StatorSlotTest, LinerAndWedgeAreKept) {
  const Slot slot = make_slot(StatorSlot{});
  for (const Edge& edge : slot.usable_area.edges())
    for (const double f : {0.0, 0.5}) {
      const Point p = edge.at(f);
      const bool beside_wedge = p.y > 16.129 - 0.42 - 1e-9 && std::abs(p.x) < 1.8415 + 1e-9;
      EXPECT_GE(slot.iron.distance(p), beside_wedge ? 0 : 0.22 - 1e-9);
    }
  EXPECT_LT(slot.usable_area.distance({0, 16.129 - 0.41}), 0);
  EXPECT_GT(slot.usable_area.distance({0, 16.129 - 0.43}), 0);
}

TEST(StatorSlotTest, SharpCornersAreATrapezoidWithASegment) {
  StatorSlot s;
  s.base_corner_radius = s.tip_corner_radius = 0;
  const double corner = s.base_radius - std::sqrt(s.base_radius * s.base_radius - 5.857 * 5.857 / 4);
  const double angle = 2 * std::asin(5.857 / 2 / s.base_radius);
  const double top = 5.857 - 2 * (16.129 - corner) * std::tan(2.5 * std::numbers::pi / 180);
  EXPECT_NEAR(top, 4.453, 5e-4);
  const double area =
      (5.857 + top) / 2 * (16.129 - corner) + s.base_radius * s.base_radius * (angle - std::sin(angle)) / 2;
  EXPECT_NEAR(make_slot(s).iron.area(), area, 1e-9);
}

TEST(PolygonSlotTest, TheMouthMayBeTheBoresArc) {
  // 8 mm wide, 12 mm deep; the mouth an arc of 30 mm about a point above it, which dips 0.27 mm below its ends.
  PolygonSlot s{{{4, 12}}, 0.2, 0, std::array{Point{4, 12}, Point{-4, 12}}};
  const double up = 12 + std::sqrt(30.0 * 30 - 16);
  for (int k = 1; k < 8; ++k) {
    const double x = 4 - k;
    s.points.push_back({x, up - std::sqrt(30.0 * 30 - x * x)});
  }
  for (const Point p : {Point{-4, 12}, {-4, 0}, {4, 0}}) s.points.push_back(p);
  const Slot slot = make_slot(s);
  ASSERT_TRUE(slot.opening);
  EXPECT_NEAR(slot.opening->clear, 8, 1e-12);
  EXPECT_NEAR(slot.opening->into.y, -1, 1e-12);
  // The same slot the other way round, and upside down.
  std::swap((*s.opening)[0], (*s.opening)[1]);
  EXPECT_NEAR(make_slot(s).opening->into.y, -1, 1e-12);
  for (Point& p : s.points) p = {-p.x, -p.y};
  for (Point& p : *s.opening) p = {-p.x, -p.y};
  EXPECT_NEAR(make_slot(s).opening->into.y, 1, 1e-12);
  // A mouth that bulges out, as a rotor's does.
  PolygonSlot out{{{4, 12}, {0, 13}, {-4, 12}, {-4, 0}, {4, 0}}, 0.2, 0, std::array{Point{4, 12}, Point{-4, 12}}};
  EXPECT_NEAR(make_slot(out).opening->into.y, -1, 1e-12);
}

TEST(PolygonSlotTest, UprightStandsOnItsBase) {
  const PolygonSlot lying{{{20, 2}, {20, 8}, {5, 9}, {5, 1}}, 0.1, 0, std::array{Point{20, 3}, Point{20, 7}}};
  const PolygonSlot standing = upright(lying).slot;
  const Slot slot = make_slot(standing);
  EXPECT_NEAR(slot.opening->middle.x, 0, 1e-12);
  EXPECT_NEAR(slot.opening->middle.y, 15, 1e-12);
  EXPECT_NEAR(slot.opening->into.y, -1, 1e-12);
  EXPECT_NEAR(slot.iron.box().low.y, 0, 1e-12);
  EXPECT_NEAR(slot.iron.area(), make_slot(lying).iron.area(), 1e-9);
  EXPECT_NEAR(slot.usable_area.area(), make_slot(lying).usable_area.area(), 1e-9);
  const UprightSlot turned = upright(lying);
  for (std::size_t i = 0; i < lying.points.size(); ++i) {
    EXPECT_NEAR(distance(turned.drawn.place(turned.slot.points[i]), lying.points[i]), 0, 1e-12);
    EXPECT_NEAR(distance(turned.drawn.foot(lying.points[i]), turned.slot.points[i]), 0, 1e-12);
  }
  EXPECT_EQ(upright(standing).slot.points, standing.points) << "a slot that stands upright is not moved";
  PolygonSlot closed = lying;
  closed.opening.reset();
  const Box box = make_slot(upright(closed).slot).iron.box();
  EXPECT_NEAR(box.low.x, -7.5, 1e-12) << "a slot without opening is not turned";
  EXPECT_NEAR(box.high.x, 7.5, 1e-12);
  EXPECT_NEAR(box.low.y, 0, 1e-12);
}

TEST(StatorSlotTest, AWedgeHasAWidthThatTheSlotLeaves) {
  const auto with = [](auto change) {
    StatorSlot s;
    change(s);
    return refused(s);
  };
  EXPECT_EQ(with([](auto& s) { s.wedge_width = 0; }), "wedge_width");
  EXPECT_EQ(with([](auto& s) { s.wedge_width = s.wedge_thickness = 0; }), "");
  EXPECT_EQ(with([](auto& s) { s.wedge_width = 4.48; }), "") << "4.453 at the tooth tips, 0.037 more below them";
  EXPECT_EQ(with([](auto& s) { s.wedge_width = 4.5; }), "wedge_width");
  EXPECT_EQ(with([](auto& s) { s.wedge_thickness = 16.2; }), "wedge_thickness");
  EXPECT_EQ(with([](auto& s) { s.base_radius = 15; }), "height");
}

TEST(StatorSlotTest, ImpossibleParametersAreNamed) {
  const auto with = [](auto change) {
    StatorSlot s;
    change(s);
    return refused(s);
  };
  EXPECT_EQ(with([](auto& s) { s.base_corner_radius = 3; }), "base_corner_radius");
  EXPECT_EQ(with([](auto& s) { s.opening_width = 4.6; }), "opening_width");
  EXPECT_EQ(with([](auto& s) { s.tip_corner_radius = 1.9; }), "tip_corner_radius");
  EXPECT_EQ(with([](auto& s) { s.base_radius = 2.9; }), "base_width");
  EXPECT_EQ(with([](auto& s) { s.height = 0.01; }), "height");
  EXPECT_EQ(with([](auto& s) { s.tip_angle = 2; }), "tip_angle");
  EXPECT_EQ(with([](auto& s) { s.liner = 3; }), "liner");
  EXPECT_EQ(with([](auto& s) {
              s.wedge_thickness = 17;
              s.wedge_width = 9;
            }),
            "wedge_thickness");
  EXPECT_EQ(with([](auto&) {}), "");
}

TEST(RotorSlotTest, WiresOfItsPitchLieSideBySideInTheGrooves) {
  const Slot slot = make_slot(RotorSlot{});
  const double first = 13.738 - 11 * 1.217;
  for (int k = 1; k < 12; ++k) EXPECT_NEAR(slot.usable_area.distance({first + k * 1.217, 0.6085}), 0.6085, 1e-9) << k;
  // b_N is rounded to 1 µm: the first wire would touch the root's flank at 0.3513, not at 0.351.
  EXPECT_NEAR(slot.usable_area.distance({first, 0.6085}), 0.6085, 3e-4);
  EXPECT_NEAR(slot.iron.area(), 59.14, 0.01);
}

TEST(RotorSlotTest, FlanksHaveTheirAnglesAndLengths) {
  RotorSlot s;
  s.root_angle = 1.9;
  s.shoe_angle = 2.3;
  const Slot slot = make_slot(s);
  const auto edges = slot.iron.edges();
  const Edge& root = edges.front();
  EXPECT_NEAR(norm(root.from), s.root_flank, 1e-12);
  EXPECT_NEAR(std::atan2(root.from.y, root.from.x), 1.9, 1e-12);
  const Edge& shoe = edges[edges.size() - 2];
  EXPECT_NEAR(shoe.length(), s.shoe_flank, 1e-12);
  EXPECT_NEAR(std::atan2(shoe.direction(0).y, shoe.direction(0).x), std::numbers::pi - 2.3, 1e-12);
  EXPECT_NEAR(norm(edges[edges.size() - 3].direction(1) - shoe.direction(0)), 0, 1e-9)
      << "the shoe's arc runs out smoothly";
}

TEST(RotorSlotTest, HalfCirclesMeetInCusps) {
  RotorSlot s;
  s.groove_pitch = 1.3;  // twice the radius
  s.base_width = s.height = 0.4 + 11 * 1.3;
  const Slot slot = make_slot(s);
  for (int k = 0; k < 11; ++k) {
    const double tip = 0.4 + 0.65 + k * 1.3;
    EXPECT_NEAR(slot.usable_area.distance({tip, 0.9}), 0.25, 1e-9) << "above the cusp";
    EXPECT_LT(slot.usable_area.distance({tip, 0.6}), 0) << "in the ridge";
  }
}

TEST(RotorSlotTest, ImpossibleParametersAreNamed) {
  const auto with = [](auto change) {
    RotorSlot s;
    change(s);
    return refused(s);
  };
  EXPECT_EQ(with([](auto& s) { s.groove_radius = 0.6; }), "groove_radius");
  EXPECT_EQ(with([](auto& s) { s.base_width = 13; }), "base_width");
  EXPECT_EQ(with([](auto& s) { s.height = 13; }), "height");
  EXPECT_EQ(with([](auto& s) { s.root_flank = 0.1; }), "root_flank") << "the closing line runs through the grooves";
  EXPECT_EQ(with([](auto& s) { s.root_flank = s.shoe_flank = 0.1; }), "root_flank");
  EXPECT_EQ(with([](auto& s) { s.grooves = 1, s.base_width = s.height = 0.5; }), "");
  EXPECT_EQ(with([](auto&) {}), "");
}

TEST(PolygonSlotTest, EitherOrientationGivesTheSameRoom) {
  PolygonSlot s{{{0, 0}, {4, 0}, {4, 3}, {2, 1}, {0, 3}}, 0.1, 0.2};
  const Slot slot = make_slot(s);
  std::reverse(s.points.begin(), s.points.end());
  EXPECT_NEAR(make_slot(s).usable_area.area(), slot.usable_area.area(), 1e-9);
  EXPECT_GT(slot.usable_area.area(), 0);
}

TEST(PolygonSlotTest, ImpossiblePolygonsAreNamed) {
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, 0, 0}), "points");          // crosses itself
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 0}, {2, 0}, {0, 4}}, 0, 0}), "points");          // turns back
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 0}, {4, 0}, {0, 4}}, 0, 0}), "points");          // a point twice
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 0}, {2, 2}, {2, 0}, {0, 4}}, 0, 0}), "points");  // touches itself
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {1, 0}, {2, 0}}, 0, 0}), "points");                  // no area
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 0}, {0, 4}}, 2, 0}), "liner");
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 0}, {0, 4}}, 0, 3}), "corner_radius");
  EXPECT_EQ(refused(PolygonSlot{{{0, 0}, {4, 0}, {0, 4}}, 0, 0}), "");
}

}  // namespace
}  // namespace bahnwerk::winding
