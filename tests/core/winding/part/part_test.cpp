#include "core/winding/part/part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/needle/obstacles.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;

/// Every place at which the input is refused, as a path.
std::string refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& e) {
    std::string places;
    for (const InputFault& f : e.faults)
      for (const std::string& part : f.place) places += "/" + part;
    return places;
  }
  return "nothing";
}

void expect_near(Vec3 a, Vec3 b, double tolerance, const std::string& what) {
  EXPECT_NEAR(norm(a - b), 0, tolerance) << what;
}

StatorPart stator(int slots) {
  StatorPart part;
  part.slots = slots;
  return part;
}
/// A slot so small that any number of poles up to 60 has room on a large enough rotor.
RotorPart rotor(int poles) {
  RotorPart part;
  part.poles = poles;
  part.heads.tooth_radius = poles <= 6 ? 40.1 : 12.0 * poles;
  return part;
}

// (4.22) with R_z(+π/2), for any slot: a place of slot coordinates turned by n·φ_Z.
TEST(Part, StatorFramesAreThoseOfTheTransformations) {
  for (int slots = 4; slots <= 60; ++slots) {
    const StatorPart part = stator(slots);
    const Slot slot = checked_slot(part);
    for (int span : {1, slots / 4, slots / 2, -1, -(slots / 3), -(slots / 2)}) {
      if (span == 0) continue;
      const int first = (7 * slots) / 9;
      const LayingRegions regions = coil_regions(part, slot, {first, span});
      const double side = span > 0 ? -1 : 1;  // a mirrored coil has mirrored sections
      for (const Point p : {Point{0, 0}, Point{1.25, 3}, Point{-2, 9}}) {
        const auto expected = [&](int n, double z) {
          const double a = n * 2 * pi / slots, r = part.heads.base_radius - p.y, t = side * p.x;
          return Vec3{r * std::cos(a) - t * std::sin(a), r * std::sin(a) + t * std::cos(a), z};
        };
        const std::string what = std::to_string(slots) + " slots, span " + std::to_string(span);
        expect_near(regions.at[0].begin.place(p), expected(first, 210), 1e-11, what);
        expect_near(regions.at[0].end.place(p), expected(first, 0), 1e-11, what);
        expect_near(regions.at[2].begin.place(p), expected(first + span, 0), 1e-11, what);
        expect_near(regions.at[2].end.place(p), expected(first + span, 210), 1e-11, what);
      }
      // The head is passed from the first side to the second, between the slots, at one radius and height.
      const Vec3 a = regions.at[1].begin.place({1, 2}), b = regions.at[1].end.place({1, 2});
      EXPECT_NEAR(std::hypot(a.x, a.y), std::hypot(b.x, b.y), 1e-11);
      EXPECT_NEAR(a.z, -17.5, 1e-12);
      EXPECT_NEAR(b.z, -17.5, 1e-12);
      const double shift = std::atan2(part.heads.tool_shift, part.heads.tool_radius + 1);
      const double swept = std::remainder(azimuth(b) - azimuth(a) - (span * part.pitch() + 2 * side * shift), 2 * pi);
      EXPECT_NEAR(swept, 0, 1e-12) << slots << " slots, span " << span;
      // The upper head goes back.
      expect_near(regions.at[3].begin.place({1, 2}), {b.x, b.y, 227.5}, 1e-11, "upper head");
      expect_near(regions.at[3].end.place({1, 2}), {a.x, a.y, 227.5}, 1e-11, "upper head");
    }
  }
}

// (4.23) for every pole and both directions.
TEST(Part, RotorFramesAreThoseOfTheTransformations) {
  for (int poles : {4, 5, 6, 8, 24, 60}) {
    const RotorPart part = rotor(poles);
    const Slot slot = checked_slot(part);
    const RotorHeads& h = part.heads;
    for (int pole = 0; pole < poles; ++pole)
      for (const bool forward : {true, false}) {
        const LayingRegions regions = coil_regions(part, slot, forward ? Coil{pole, 1} : Coil{pole + 1, -1});
        const double side = forward ? -1 : 1;
        for (const Point p : {Point{0, 0}, Point{5, 3}, Point{-2, 4}}) {
          const auto expected = [&](double y, double z) {
            return turned({h.tooth_radius + p.x, y, z}, pole * 2 * pi / poles);
          };
          const double y = h.tooth_half_width + p.y;
          expect_near(regions.at[0].begin.place(p), expected(side * y, 212.6), 1e-10, "down");
          expect_near(regions.at[0].end.place(p), expected(side * y, -10.6), 1e-10, "down");
          expect_near(regions.at[2].begin.place(p), expected(-side * y, -10.6), 1e-10, "up");
          expect_near(regions.at[2].end.place(p), expected(-side * y, 212.6), 1e-10, "up");
          expect_near(regions.at[1].begin.place(p), expected(side * h.tooth_half_width, -10.6 - p.y), 1e-10, "below");
          expect_near(regions.at[3].begin.place(p), expected(-side * h.tooth_half_width, 212.6 + p.y), 1e-10, "above");
        }
        EXPECT_EQ(regions.hold, h.hold);
      }
  }
}

// What is laid does not depend on where the coil lies.
TEST(Part, LayoutsAreTheSameForEveryPlaceAndDirection) {
  Progress silent;
  const StatorPart part = stator(36);
  const Slot slot = checked_slot(part);
  const auto laid = [&](Coil coil) { return needle(coil_regions(part, slot, coil), 0.6, slot.tension_point, silent); };
  const NeedleLayout first = laid({0, -7});
  ASSERT_GT(first[0].wires.size(), 30u);
  for (const Coil coil : {Coil{11, -7}, Coil{0, 7}, Coil{35, 7}}) {
    const NeedleLayout other = laid(coil);
    for (std::size_t j = 0; j < 4; ++j) {
      ASSERT_EQ(other[j].wires.size(), first[j].wires.size());
      for (std::size_t i = 0; i < first[j].wires.size(); ++i)
        EXPECT_NEAR(distance(other[j].wires[i], first[j].wires[i]), 0, 1e-6) << coil.span << ": " << j << ", " << i;
    }
  }
}

TEST(Part, ACoilGoesTheShorterWayRound) {
  const StatorPart part = stator(48);
  EXPECT_EQ(coil_between(part, 0, 5), (Coil{0, 5}));
  EXPECT_EQ(coil_between(part, 5, 0), (Coil{5, -5}));
  EXPECT_EQ(coil_between(part, 46, 3), (Coil{46, 5}));
  EXPECT_EQ(coil_between(part, 3, 46), (Coil{3, -5}));
  EXPECT_EQ(coil_between(part, 43, 48), (Coil{43, 5})) << "48 is slot 0 again";
  EXPECT_EQ(coil_between(part, 0, 24), (Coil{0, 24})) << "half the stator: as the numbers count";
  EXPECT_EQ(coil_between(part, 24, 0), (Coil{24, -24}));
  EXPECT_EQ(coil_between(part, 0, 25), (Coil{0, -23}));
  EXPECT_EQ(reversed({46, 5}), (Coil{51, -5}));
}

TEST(Part, ARotorsCoilLiesAboutOnePole) {
  const RotorPart part = rotor(6);
  EXPECT_EQ(coil_between(part, 2, 3), (Coil{2, 1}));
  EXPECT_EQ(coil_between(part, 3, 2), (Coil{3, -1}));
  EXPECT_EQ(coil_between(part, 5, 0), (Coil{5, 1}));
  EXPECT_EQ(coil_between(part, 5, 6), (Coil{5, 1}));
  EXPECT_EQ(coil_between(part, 0, 5), (Coil{0, -1}));
  EXPECT_EQ(refused([&] { coil_between(part, 1, 3); }), "/coil/slots");
  EXPECT_EQ(refused([&] { coil_between(part, 2, 2); }), "/coil/slots");
  EXPECT_EQ(refused([&] { coil_regions(part, checked_slot(part), {0, 2}); }), "/coil/slots");
  // Of two poles each has its own pair of numbers, in both directions.
  const RotorPart two = rotor(2);
  EXPECT_EQ(coil_between(two, 0, 1), (Coil{0, 1}));
  EXPECT_EQ(coil_between(two, 1, 0), (Coil{1, -1}));
  EXPECT_EQ(coil_between(two, 1, 2), (Coil{1, 1}));
  EXPECT_EQ(coil_between(two, 2, 1), (Coil{2, -1}));
}

TEST(Part, CoilsRepeatOverSlotsAndPoles) {
  EXPECT_EQ(repeated({0, 5}, 48, 6, 8, false).back(), (Coil{42, 5}));
  EXPECT_EQ(repeated({46, 5}, 48, 1, 3, false), (std::vector<Coil>{{46, 5}, {47, 5}, {0, 5}}));
  EXPECT_EQ(repeated({0, 1}, 6, 1, 3, true), (std::vector<Coil>{{0, 1}, {2, -1}, {2, 1}}));
  EXPECT_EQ(repeated({0, 24}, 48, -12, 3, false), (std::vector<Coil>{{0, 24}, {36, 24}, {24, 24}}));
  EXPECT_TRUE(repeated({0, 1}, 6, 1, 0, false).empty());
  EXPECT_EQ(repeated({3, 5}, 48, 2000000000, 40, false).size(), 40u);
}

TEST(Part, ImpossiblePartsAreRefusedByName) {
  EXPECT_EQ(refused([] { coil_between(stator(48), -1, 49); }), "/coil/slots/0/coil/slots/1");
  EXPECT_EQ(refused([] { coil_between(stator(48), 7, 7); }), "/coil/slots");
  EXPECT_EQ(refused([] { coil_between(stator(48), 0, 48); }), "/coil/slots") << "the same slot";
  EXPECT_EQ(refused([] { checked_slot(stator(1)); }), "/part/slots");
  EXPECT_EQ(refused([] { checked_slot(stator(48)); }), "nothing");
  // Widest, as seen from the axis, at the corner of base and flank: 102 slots have room, 103 have not.
  EXPECT_EQ(refused([] { checked_slot(stator(103)); }), "/part/slots");
  EXPECT_EQ(refused([] { checked_slot(stator(102)); }), "nothing");
  StatorPart part = stator(48);
  part.heads.base_radius = 16;
  EXPECT_EQ(refused([&] { checked_slot(part); }), "/part/base_radius");
  part = stator(48);
  part.heads.tool_shift = 7;  // 2 · 4.0° of 7.5°
  EXPECT_EQ(refused([&] { coil_regions(part, checked_slot(part), {0, 1}); }), "/part/tool_shift");
  EXPECT_EQ(refused([&] { coil_regions(part, checked_slot(part), {0, 2}); }), "nothing");
  EXPECT_EQ(refused([&] { coil_regions(part, checked_slot(part), {0, 0}); }), "/coil/slots");
  EXPECT_EQ(refused([] { checked_slot(rotor(1)); }), "/part/poles");
  EXPECT_EQ(refused([] { checked_slot(rotor(6)); }), "nothing");
  RotorPart crowded = rotor(6);
  crowded.poles = 9;
  EXPECT_EQ(refused([&] { checked_slot(crowded); }), "/part/poles");
  RotorPart bad = rotor(6);
  bad.slot.height = 1;
  EXPECT_EQ(refused([&] { checked_slot(bad); }), "/slot/height");
}

TEST(Part, TellsWhatPassesAndWhatIsBesides) {
  const StatorPart stator;
  EXPECT_NEAR(bore(stator), 2 * (95.7 - 16.129), 1e-9);
  EXPECT_NEAR(clear_way(stator, checked_slot(stator)), 3.083, 1e-12);
  const Slot slot = checked_slot(stator);
  EXPECT_TRUE(leaves_teeth(slot, 95.7, 7.5 * std::acos(-1.0) / 180));
  EXPECT_FALSE(leaves_teeth(slot, 95.7, 3 * std::acos(-1.0) / 180));
  // Where the coils of two poles come nearest, seen from the plane between them.
  const RotorPart rotor;
  const Slot beside = checked_slot(rotor);
  double nearest = 1e9;
  for (const Edge& e : beside.iron.edges()) {
    const double x = rotor.heads.tooth_radius + e.from.x, y = rotor.heads.tooth_half_width + e.from.y;
    nearest = std::min(nearest, x * std::sin(rotor.pitch() / 2) - y * std::cos(rotor.pitch() / 2));
  }
  EXPECT_NEAR(clear_way(rotor, beside), 2 * nearest, 1e-9);
  EXPECT_GT(nearest, 0);
}

TEST(Part, ADrawnSlotIsTheOneOfItsSizes) {
  // Sharp corners, so that the outline is drawn by its corners but for the base's arc.
  StatorPart sized;
  sized.slot.base_corner_radius = sized.slot.tip_corner_radius = sized.slot.wedge_thickness = sized.slot.wedge_width =
      0;
  sized.slot.opening_width = 4;
  const Slot slot = checked_slot(sized);
  PolygonSlot drawn{{}, sized.slot.liner, 0, std::array{Point{-2, 16.129}, Point{2, 16.129}}};
  for (const Edge& edge : slot.iron.edges()) {
    const int parts = edge.straight() ? 1 : 60;
    for (int k = 0; k < parts; ++k) drawn.points.push_back(edge.at(static_cast<double>(k) / parts));
  }
  const StatorPart part = drawn_stator(drawn, 95.7);
  EXPECT_NEAR(bore(part), bore(sized), 1e-6);
  EXPECT_NEAR(clear_way(part, checked_slot(part)), 4, 1e-9);
  const StatorIron is(part, checked_slot(part)), was(sized, slot);
  for (const Vec3 p : {Vec3{90, 0.5, 100}, {79, 1.9, 100}, {85, -2.3, 50}, {80, 3, 10}, {60, 20, 200}, {70, 0, 100}})
    EXPECT_NEAR(is.distance(p), was.distance(p), 0.01) << p.x << ' ' << p.y;
}

}  // namespace
}  // namespace bahnwerk::winding
