#include "core/winding/laying/needle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/layout/sites.hpp"
#include "core/winding/wire.hpp"
#include "tests/core/geometry/region/rooms.hpp"
#include "tests/core/winding/layout/drawn_to.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

/// Greatest distance of a wire from the lattice through the first one with rows along x.
double off_lattice(const Layout& layout, double radius, const std::function<bool(Point)>& counts) {
  double most = 0;
  for (const Point p : layout.wires) {
    if (!counts(p)) continue;
    const Point d = p - layout.wires[0];
    const double row = std::round(d.y / (std::sqrt(3) * radius)), beside = d.x / (2 * radius) - row / 2;
    const Point nearest{2 * radius * (std::round(beside) + row / 2), std::sqrt(3) * radius * row};
    most = std::max(most, distance(d, nearest));
  }
  return most;
}
bool all(Point) { return true; }

/// The rotor slot with a pole shoe that fits the wire as closely as the root does, and an open side along the base.
RotorSlot closely_fitting(double radius) {
  RotorSlot slot;
  slot.shoe_radius = radius;
  slot.base_width = 11 * slot.groove_pitch + radius / std::tan(slot.root_angle / 2);
  slot.shoe_flank = slot.root_flank - radius / std::tan(slot.root_angle / 2);
  return slot;
}

TEST(Needle, AllRegionsHoldEveryTurnAndTheSlotIsFull) {
  const Slot slot = make_slot(StatorSlot{});
  const LayingRegions regions = laying_regions(slot, StatorHeads{});
  for (const Wire& wire : standard_wires(2, 0.5, 1.6, Series::r20)) {
    const NeedleLayout n = needle(regions, wire.radius(), slot.tension_point, silent);
    bool full = false;
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(n[j].wires.size(), n[0].wires.size());
      EXPECT_EQ(n[j].tension_points.size(), n[0].wires.size());
      EXPECT_TRUE(test::valid(regions.at[j].usable_area, wire.radius(), n[j].wires));
      Sites sites(regions.at[j].usable_area, wire.radius());
      for (const Point p : n[j].wires) sites.lay(p);
      if (!sites.nearest(slot.tension_point)) full = true;
      if (j % 2 == 1) {
        EXPECT_TRUE(sites.nearest(slot.tension_point));  // heads never run out of space
      }
    }
    EXPECT_TRUE(full);
  }
}

TEST(Needle, EveryWireIsDrawnFromTheRegionBefore) {
  const Slot slot = make_slot(StatorSlot{});
  const StatorHeads h;
  const NeedleLayout n = needle(slot, 0.4945, h, silent);
  EXPECT_EQ(n[0].tension_points[0], slot.tension_point);
  for (std::size_t i = 0; i < n[0].wires.size(); ++i) {
    // Closed forms of the stator's frames: the tools stand b_WK beside the slots and r_WK − r_NG behind their bases.
    const double behind = h.tool_radius - h.base_radius;
    EXPECT_NEAR(distance(n[1].tension_points[i], {-behind - n[0].wires[i].y, -h.tool_height}), 0, 1e-9);
    EXPECT_NEAR(distance(n[2].tension_points[i], {h.tool_shift, -behind - n[1].wires[i].x}), 0, 1e-9);
    EXPECT_NEAR(distance(n[3].tension_points[i], {-behind - n[2].wires[i].y, -h.tool_height}), 0, 1e-9);
    if (i > 0) {
      EXPECT_NEAR(distance(n[0].tension_points[i], {-h.tool_shift, -behind - n[3].wires[i - 1].x}), 0, 1e-9);
    }
  }
}

TEST(Needle, EveryWireTakesTheNearestPlace) {
  const Slot slot = make_slot(StatorSlot{});
  const LayingRegions regions = laying_regions(slot, StatorHeads{});
  const NeedleLayout n = needle(regions, 0.7, slot.tension_point, silent);
  for (const std::size_t j : {0u, 1u, 2u}) {
    std::vector<Point> laid;
    for (std::size_t i = 0; i < n[j].wires.size(); ++i) {
      const Point tension_point = n[j].tension_points[i];
      EXPECT_LE(distance(n[j].wires[i], tension_point),
                test::sampled_least(regions.at[j].usable_area, 0.7, laid, [&](Point q) {
                  return distance(q, tension_point);
                }) + 1e-9);
      laid.push_back(n[j].wires[i]);
    }
  }
}

TEST(Needle, BestElectricalFillOfTheStatorIsThatOfTheSource) {
  // [Herrmann 4.2.4]: 0.90 mm of copper.
  const Slot slot = make_slot(StatorSlot{});
  double best = 0, copper = 0;
  for (const Wire& wire : standard_wires(2, 0.5, 1.6, Series::r20)) {
    const auto n = static_cast<double>(needle(slot, wire.radius(), StatorHeads{}, silent)[0].wires.size());
    if (n * wire.copper * wire.copper > best) {
      best = n * wire.copper * wire.copper;
      copper = wire.copper;
    }
  }
  EXPECT_EQ(copper, 0.9);
}

TEST(Needle, CloselyFittingRotorSlotIsWoundOrthocyclically) {
  const double r = 0.6085;
  const Slot slot = make_slot(closely_fitting(r));
  const NeedleLayout n = needle(slot, r, RotorHeads{}, silent);
  for (const Layout& layout : n) {
    EXPECT_GE(layout.wires.size(), 12u + 13 + 14);
    EXPECT_LT(off_lattice(layout, r, all), 1e-6);
    // Wires between two full rows touch six others.
    std::size_t inner = 0;
    for (const Point p : layout.wires) {
      std::size_t touching = 0;
      for (const Point q : layout.wires) touching += p != q && distance(p, q) < 2 * r + 1e-6;
      const double row = std::round((p.y - layout.wires[0].y) / (std::sqrt(3) * r));
      if (row == 1 && p.x > 0.5 && p.x < 13.5) {
        EXPECT_EQ(touching, 6u);
        ++inner;
      }
    }
    EXPECT_EQ(inner, 11u);
  }
}

TEST(Needle, RotorSlotOfTheTableLeavesTheLatticeOnlyByItsPlay) {
  // The groove's radius of 0.65 leaves wires a play of 0.02 at the pole shoe; what does not lean there or on the open
  // side lies on the lattice.
  const double r = 0.6085;
  const Slot slot = make_slot(RotorSlot{});
  const NeedleLayout n = needle(slot, r, RotorHeads{}, silent);
  const auto& edges = slot.usable_area.edges();
  const auto free_of_play = [&](Point p) {
    for (std::size_t i = edges.size() - 2; i < edges.size(); ++i)
      if (distance(p, edges[i].at(edges[i].nearest(p))) < r + 1e-6) return false;
    return true;
  };
  EXPECT_GE(n[0].wires.size(), 38u);
  EXPECT_LT(off_lattice(n[0], r, free_of_play), 1e-6);
  EXPECT_LT(off_lattice(n[0], r, all), 0.03);
}

TEST(Needle, GroovesWiderApartThanAWireAreFilledFirst) {
  RotorSlot wide;
  wide.groove_pitch = 1.25;
  wide.base_width = 11 * 1.25 + 0.36;
  wide.height = 16;
  const double r = 0.6;
  const NeedleLayout n = needle(make_slot(wide), r, RotorHeads{}, silent);
  ASSERT_GT(n[0].wires.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_LT(n[0].wires[i].y, 0.7);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT(distance(n[0].wires[i], n[0].wires[k]), 2 * r + 0.01);
  }
}

TEST(Needle, SameInputGivesTheSameBits) {
  const Slot slot = make_slot(StatorSlot{});
  const NeedleLayout a = needle(slot, 0.442, StatorHeads{}, silent), b = needle(slot, 0.442, StatorHeads{}, silent);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(a[j].wires, b[j].wires);
    EXPECT_EQ(a[j].tension_points, b[j].tension_points);
  }
}

TEST(Needle, RowsThatFitExactlyAreFilledFromBothSides) {
  // Drawn to the middle, wires come from there outwards, the last ones into places exactly as wide as they are.
  Random random(8);
  for (int round = 0; round < 40; ++round) {
    const double r = random.uniform(0.2, 1.5);
    const std::size_t k = 3 + 2 * random.below(4);
    const Region row = test::rectangle(2 * r * static_cast<double>(k), 2 * r);
    const double middle = r * static_cast<double>(k);
    EXPECT_EQ(test::drawn_to(row, r, {middle, -1}).size(), k);
    EXPECT_EQ(test::drawn_to(row, r, {-1, -1}).size(), k);
  }
}

TEST(Needle, NothingFits) {
  const Slot slot = make_slot(StatorSlot{});
  for (const Layout& layout : needle(slot, 3, StatorHeads{}, silent)) EXPECT_TRUE(layout.wires.empty());
  EXPECT_TRUE(test::drawn_to(test::rectangle(9, 1), 0.6, {0, 0}).empty());
}

TEST(Needle, StopsWhenToldTo) {
  struct Stop : ProgressSink {
    int calls = 0;
    void report(std::string_view, double fraction, std::string_view) override {
      EXPECT_GE(fraction, 0);
      EXPECT_LE(fraction, 1);
      if (++calls == 5) throw Stopped(StopReason::cancelled);
    }
  } stop;
  EXPECT_THROW(needle(make_slot(StatorSlot{}), 0.4, StatorHeads{}, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk::winding
