#include "core/contour/gcode/moves/offset_piece.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/numeric/random.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double pi = std::numbers::pi;

void expect_at(Vec found, Vec expected) { EXPECT_LE(norm(found - expected), 1e-12) << found.x << ' ' << found.y; }

TEST(OffsetPiece, ALineMovesToItsLeft) {
  const OffsetPiece p = offset_line({1, 1, 5}, {4, 5, 7}, 2.5);
  expect_at(p.from, {-1, 2.5, 0});
  expect_at(p.to, {2, 6.5, 0});
  expect_at(p.direction_from, {0.6, 0.8, 0});
  EXPECT_EQ(p.length, 5);
  expect_at(offset_line({1, 1}, {4, 5}, -2.5).from, {3, -0.5, 0});
}

TEST(OffsetPiece, AnArcShrinksOnItsInnerSideAndVanishes) {
  const Vec from{3, 0}, to{0, 3};
  const auto inner = offset_arc({from, to, {}, 1, pi / 2}, 1, 1e-6);  // counter-clockwise: the centre is on the left
  ASSERT_TRUE(inner);
  EXPECT_DOUBLE_EQ(inner->radius, 2);
  EXPECT_DOUBLE_EQ(inner->length, pi);
  expect_at(inner->to, {0, 2, 0});
  expect_at(inner->direction_from, {0, 1, 0});
  expect_at(inner->direction_to, {-1, 0, 0});
  EXPECT_DOUBLE_EQ(offset_arc({from, to, {}, 1, pi / 2}, -1, 1e-6)->radius, 4);
  EXPECT_DOUBLE_EQ(offset_arc({to, from, {}, -1, pi / 2}, 1, 1e-6)->radius, 4) << "clockwise";
  const auto point = offset_arc({from, to, {}, 1, pi / 2}, 3, 1e-6);
  ASSERT_TRUE(point) << "just its centre";
  EXPECT_EQ(point->length, 0);
  EXPECT_FALSE(offset_arc({from, to, {}, 1, pi / 2}, 3.1, 1e-6));
}

TEST(OffsetPiece, TrimmedItIsShorterByThat) {
  OffsetPiece arc = *offset_arc({{2, 0}, {-2, 0}, {}, 1, pi}, 0, 1e-6);
  arc.trim_begin(pi / 2, turned({2, 0}, pi / 4));
  arc.trim_end(pi / 2, turned({2, 0}, 3 * pi / 4));
  EXPECT_NEAR(arc.length, pi, 1e-12);
  EXPECT_NEAR(arc.sweep, pi / 2, 1e-12);
  expect_at(arc.corner_from, {2, 0});
  OffsetPiece line = offset_line({0, 0}, {1, 0}, 0);
  line.trim_end(5, {0, 0});
  EXPECT_EQ(line.length, 0) << "never below 0";
}

TEST(OffsetPiece, TurnsAndAnglesBelongTogether) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Vec v{random.uniform(-3, 3), random.uniform(-3, 3)};
    const double angle = random.uniform(-3.1, 3.1);
    EXPECT_NEAR(turn_of(v, turned(v, angle)), angle, 1e-12);
    EXPECT_NEAR(dot(left_of(v), v), 0, 1e-12);
    EXPECT_NEAR(turn_of(v, left_of(v)), pi / 2, 1e-12);
  }
}

// Any corner between two pieces that meet there, offset to the inner side: the crossing has the cutter's distance from
// both, and what is cut off reaches to it.
TEST(OffsetPiece, PiecesMeetAtTheCuttersDistanceFromBoth) {
  Random random(9);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const double aside = random.uniform(0.05, 0.3);
    const Vec in = turned({1, 0}, random.uniform(-3, 3)), out = turned(in, random.uniform(0.2, 2.2));  // to the left
    const auto piece = [&](Vec direction, bool ends) {
      const double sign = ends ? -1 : 1;
      if (random.chance(0.5))
        return offset_line(ends ? sign * 4 * direction : Vec{}, ends ? Vec{} : 4 * direction, aside);
      const double radius = random.uniform(1, 5), sense = random.chance(0.5) ? 1 : -1, sweep = random.uniform(0.6, 1.5);
      const Vec centre = sense * radius * left_of(direction), away = centre + turned(-centre, sign * sense * sweep);
      return *offset_arc({ends ? away : Vec{}, ends ? Vec{} : away, centre, sense, sweep}, aside, 1e-9);
    };
    const OffsetPiece first = piece(in, true), second = piece(out, false);
    const auto found = meeting(first, second, 1e-9);
    if (!found) continue;
    ++met;
    for (const OffsetPiece* p : {&first, &second}) {
      const double away = p->arc ? std::abs(norm(found->at - p->centre) - p->radius)
                                 : std::abs(dot(found->at - p->from, left_of(p->direction_from)));
      EXPECT_LE(away, 1e-9) << i;
    }
    // The length of a piece from the crossing on: by walking along it.
    const auto along = [](const OffsetPiece& p, double length, bool back) {
      if (!p.arc) return back ? p.to - length * p.direction_to : p.from + length * p.direction_from;
      const double angle = p.sense * length / p.radius;
      return p.centre + (back ? turned(p.to - p.centre, -angle) : turned(p.from - p.centre, angle));
    };
    EXPECT_LE(norm(along(first, found->before, true) - found->at), 1e-8) << i;
    EXPECT_LE(norm(along(second, found->behind, false) - found->at), 1e-8) << i;
  }
  EXPECT_GT(met, 300);
}

TEST(OffsetPiece, ParallelLinesAndCirclesApartDoNotMeet) {
  EXPECT_FALSE(meeting(offset_line({0, 0}, {1, 0}, 0), offset_line({1, 0.1}, {2, 0.1}, 0), 1));
  const auto circle = [](Vec centre) {
    return *offset_arc({centre + Vec{1, 0}, centre - Vec{1, 0}, centre, 1, pi}, 0, 1e-9);
  };
  EXPECT_FALSE(meeting(circle({0, 0}), circle({5, 0}), 1));
  EXPECT_FALSE(meeting(circle({0, 0}), circle({0, 0}), 1)) << "one circle crosses itself nowhere";
  EXPECT_FALSE(meeting(offset_line({-5, 3}, {5, 3}, 0), circle({0, 0}), 1));
}

}  // namespace
}  // namespace bahnwerk::gcode
