#include "core/winding/laying/laying_regions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::winding {
namespace {

/// Homogeneous elementary transformations as [Herrmann (4.22), (4.23)] chain them.
struct Matrix {
  double a[4][4];
};
Matrix operator*(const Matrix& l, const Matrix& r) {
  Matrix m{};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j) m.a[i][k] += l.a[i][j] * r.a[j][k];
  return m;
}
Matrix shift(double x, double y, double z) { return {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}}; }
Matrix turn_z(double t) {
  return {{{std::cos(t), -std::sin(t), 0, 0}, {std::sin(t), std::cos(t), 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}
Matrix turn_x(double t) {
  return {{{1, 0, 0, 0}, {0, std::cos(t), -std::sin(t), 0}, {0, std::sin(t), std::cos(t), 0}, {0, 0, 0, 1}}};
}
void expect_same(const Matrix& m, const Frame& frame) {
  for (const Point p : {Point{0, 0}, Point{1.5, -2}, Point{-4, 7}}) {
    const Vec3 found = frame.place(p);
    EXPECT_NEAR(found.x, m.a[0][0] * p.x + m.a[0][1] * p.y + m.a[0][3], 1e-12);
    EXPECT_NEAR(found.y, m.a[1][0] * p.x + m.a[1][1] * p.y + m.a[1][3], 1e-12);
    EXPECT_NEAR(found.z, m.a[2][0] * p.x + m.a[2][1] * p.y + m.a[2][3], 1e-12);
  }
}

LayingRegions stator() { return laying_regions(make_slot(StatorSlot{}), StatorHeads{}); }
LayingRegions rotor() { return laying_regions(make_slot(RotorSlot{}), RotorHeads{}); }

TEST(LayingRegions, StatorSlotsStandAsInTheirTransformations) {
  const LayingRegions r = stator();
  const StatorHeads h;
  const double quarter = std::acos(0.0);
  expect_same(shift(h.base_radius, 0, h.stack) * turn_z(quarter), r.at[0].begin);
  expect_same(shift(h.base_radius, 0, 0) * turn_z(quarter), r.at[0].end);
  const Matrix second = turn_z(-h.span * h.slot_pitch);
  expect_same(second * shift(h.base_radius, 0, 0) * turn_z(quarter), r.at[2].begin);
  expect_same(second * shift(h.base_radius, 0, h.stack) * turn_z(quarter), r.at[2].end);
}

TEST(LayingRegions, RotorSlotsStandAsInTheirTransformations) {
  const LayingRegions r = rotor();
  const RotorHeads h;
  const double half_turn = 2 * std::acos(0.0);
  expect_same(shift(h.tooth_radius, -h.tooth_half_width, h.stack + h.cap_base) * turn_x(half_turn), r.at[0].begin);
  expect_same(shift(h.tooth_radius, -h.tooth_half_width, -h.cap_base) * turn_x(half_turn), r.at[0].end);
  // The second slot mirrors the first at the tooth.
  for (const Point p : {Point{1, 2}, Point{-3, 0.5}}) {
    const Vec3 a = r.at[0].begin.place(p), b = r.at[2].end.place(p);
    EXPECT_NEAR(a.x, b.x, 1e-12);
    EXPECT_NEAR(a.y, -b.y, 1e-12);
    EXPECT_NEAR(a.z, b.z, 1e-12);
  }
}

TEST(LayingRegions, FramesAreOrthonormalAndEndsAreParallel) {
  for (const LayingRegions& regions : {stator(), rotor()})
    for (const LayingRegion& region : regions.at)
      for (const Frame& f : {region.begin, region.end}) {
        EXPECT_NEAR(dot(f.x, f.x), 1, 1e-14);
        EXPECT_NEAR(dot(f.y, f.y), 1, 1e-14);
        EXPECT_NEAR(dot(f.x, f.y), 0, 1e-14);
      }
}

TEST(LayingRegions, HeadsLieBehindTheToolAndBeyondItsHeight) {
  const LayingRegions r = stator();
  const StatorHeads h;
  for (const std::size_t j : {1u, 3u})
    for (const Frame& f : {r.at[j].begin, r.at[j].end}) {
      const Vec3 corner = f.place({0, 0}), far = f.place({3, 2});
      const double out = j == 1 ? -1 : 1, end = j == 1 ? 0 : h.stack;
      EXPECT_NEAR(out * (corner.z - end), h.tool_height, 1e-12);
      EXPECT_NEAR(out * (far.z - corner.z), 2, 1e-12);
      EXPECT_NEAR(std::hypot(corner.x, corner.y), std::hypot(h.tool_radius, h.tool_shift), 1e-9);
      EXPECT_GT(std::hypot(far.x, far.y), std::hypot(corner.x, corner.y) + 2.9);
    }
}

TEST(LayingRegions, FootKeepsThePartOfAForceThatIsNormalToTheWire) {
  Random random(2);
  const LayingRegions regions = stator();
  for (int i = 0; i < 50; ++i) {
    const Frame& f = regions.at[static_cast<std::size_t>(i % 4)].begin;
    const Vec3 wire{f.x.y * f.y.z - f.x.z * f.y.y, f.x.z * f.y.x - f.x.x * f.y.z, f.x.x * f.y.y - f.x.y * f.y.x};
    const Vec3 from{random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)};
    const Point place{random.uniform(-5, 5), random.uniform(-5, 5)};
    const Vec3 force = from - f.place(place);  // (4.15)
    const double along = dot(force, wire);
    EXPECT_NEAR(distance(f.foot(from), place), std::sqrt(dot(force, force) - along * along), 1e-9);
  }
}

TEST(LayingRegions, CapContinuesGroovesAndFlanks) {
  const Slot slot = make_slot(RotorSlot{});
  const RotorHeads h;
  const Region cap = rotor().at[1].usable_area;
  EXPECT_NEAR(cap.box().high.y, h.cap_height - h.cap_base, 1e-9);
  // Near base and flanks it is the slot.
  for (const Point p : {Point{0.3513, 0.3}, Point{7, 0.2}, Point{13.7, 0.4}, Point{-1, 2.5}, Point{14.9, 2}})
    EXPECT_NEAR(cap.distance(p), slot.usable_area.distance(p), 1e-9);
  EXPECT_GT(cap.area(), 2 * slot.usable_area.area());
}

TEST(LayingRegions, RefusesASlotWithoutFlanks) {
  Slot round;
  round.usable_area = Region({arc({0, 2}, 2, -std::acos(0.0), 4 * std::acos(0.0))});
  EXPECT_THROW(laying_regions(round, RotorHeads{}), std::invalid_argument);
}

TEST(LayingRegions, RefusesACapWithoutHeight) {
  RotorHeads flat;
  flat.cap_height = flat.cap_base;
  EXPECT_THROW(laying_regions(make_slot(RotorSlot{}), flat), InvalidInput);
  // Flanks that lean towards each other meet 12 mm above the base.
  RotorSlot narrow;
  narrow.root_angle = narrow.shoe_angle = std::acos(0.5);
  EXPECT_THROW(laying_regions(make_slot(narrow), RotorHeads{}), InvalidInput);
}

}  // namespace
}  // namespace bahnwerk::winding
