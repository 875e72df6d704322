#include "core/winding/part/turns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

TEST(Layers, AreTheRowsOfALattice) {
  std::vector<Point> wires;
  const double pitch = 2, rise = std::sqrt(3.0);
  std::vector<int> expected;
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 8 - row; ++i) {
      // Every other row is laid backwards.
      wires.push_back({pitch * (row % 2 ? 7 - row - i : i) + row, row * rise});
      expected.push_back(row + 1);
    }
  EXPECT_EQ(layers(wires, 1), expected);
  // As a section that is turned upside down has it: nothing lies under anything.
  for (Point& p : wires) p.y = -p.y;
  EXPECT_EQ(layers(wires, 1), std::vector<int>(wires.size(), 1));
  EXPECT_TRUE(layers({}, 1).empty());
}

TEST(Layers, NeighboursBesideDoNotCarry) {
  EXPECT_EQ(layers({{0, 0}, {1.8, 0.85}}, 1), (std::vector<int>{1, 1})) << "25° above";
  EXPECT_EQ(layers({{0, 0}, {1.6, 1.2}}, 1), (std::vector<int>{1, 2})) << "37° above";
  EXPECT_EQ(layers({{0, 0}, {0, 2.05}}, 1), (std::vector<int>{1, 1})) << "a gap of 2.5 %";
  EXPECT_EQ(layers({{0, 0}, {0, 2.03}}, 1), (std::vector<int>{1, 2})) << "one of 1.5 %";
}

TEST(Turns, FollowTheLayoutsOfEveryCoil) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const double radius = 0.5;
  std::vector<LayingRegions> coils;
  const std::vector<Coil> places = repeated({0, 5}, part.slots, 6, 3, true);
  for (const Coil coil : places) coils.push_back(coil_regions(part, slot, coil));
  const NeedleLayout layouts = needle(coils[0], radius, slot.tension_point, silent);
  const std::size_t count = layouts[0].wires.size();
  const std::vector<Turn> turns = turns_of(coils, layouts, count, radius);
  ASSERT_EQ(turns.size(), 3 * count);
  const std::vector<int> layer = layers(layouts[0].wires, radius);
  for (std::size_t n = 0; n < turns.size(); ++n) {
    const Turn& t = turns[n];
    EXPECT_EQ(t.coil, n / count);
    EXPECT_EQ(t.number, n % count);
    EXPECT_EQ(t.layer, layer[t.number]);
    EXPECT_EQ(t.layer_jump, t.number > 0 && layer[t.number] != layer[t.number - 1]);
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(t.at[j].begin, coils[t.coil].at[j].begin.place(layouts[j].wires[t.number]));
      EXPECT_EQ(t.at[j].end, coils[t.coil].at[j].end.place(layouts[j].wires[t.number]));
      if (j > 0) {
        EXPECT_EQ(t.at[j].held, t.at[j - 1].end) << "a stator's wire is held at the region's end";
      } else if (t.number > 0) {
        EXPECT_EQ(t.at[j].held, turns[n - 1].at[3].end);
      } else {
        EXPECT_EQ(t.at[j].held, t.at[3].end);
      }
    }
    // Down through the first slot, up through the other.
    EXPECT_EQ(t.at[0].begin.z, 210);
    EXPECT_EQ(t.at[0].end.z, 0);
    EXPECT_EQ(t.at[2].end.z, 210);
  }
  // Consecutive turns of a coil touch or nearly touch; none is farther away than its slot is wide.
  for (std::size_t i = 1; i < count; ++i)
    EXPECT_GE(distance(layouts[0].wires[i], layouts[0].wires[i - 1]), 2 * radius - 1e-9);
}

TEST(Turns, JumpOncePerLayerInTheExampleRotor) {
  const RotorPart part;
  const Slot slot = checked_slot(part);
  const LayingRegions coil = coil_regions(part, slot, {0, 1});
  const double radius = 1.217 / 2;
  const NeedleLayout layouts = needle(coil, radius, slot.tension_point, silent);
  ASSERT_GT(layouts[0].wires.size(), 30u);
  const std::vector<Turn> turns = turns_of({coil}, layouts, layouts[0].wires.size(), radius);
  int jumps = 0, highest = 0;
  for (const Turn& t : turns) jumps += t.layer_jump, highest = std::max(highest, t.layer);
  EXPECT_GE(highest, 3);
  EXPECT_EQ(jumps, highest - 1) << "row by row";
  // A wire is held 5 mm before the edge (Fig. 4.10).
  EXPECT_NEAR(norm(turns[3].at[1].held - turns[3].at[0].end), 5, 1e-9);
}

TEST(Turns, AreAsManyAsTheLayoutsHaveOrInfeasible) {
  const StatorPart part;
  const Slot slot = checked_slot(part);
  const LayingRegions coil = coil_regions(part, slot, {0, -5});
  NeedleLayout one;
  for (Layout& layout : one) layout.wires = {{0, 5}};
  EXPECT_EQ(turns_of({coil}, one, 1, 0.5).size(), 1u) << "a slot with one wire";
  EXPECT_TRUE(turns_of({coil}, one, 0, 0.5).empty());
  EXPECT_TRUE(turns_of({}, one, 1, 0.5).empty());
  EXPECT_THROW(turns_of({coil}, one, 2, 0.5), Infeasible);
  one[2].wires.clear();
  EXPECT_THROW(turns_of({coil}, one, 1, 0.5), Infeasible);
}

TEST(Turns, PassThroughTheMiddleOfThePlacesOfSeveralWires) {
  const RotorPart part;
  const Slot slot = checked_slot(part);
  const std::vector<LayingRegions> coils{coil_regions(part, slot, {0, 1})};
  const NeedleLayout layouts = needle(coils[0], 0.5, slot.tension_point, silent);
  const std::size_t count = layouts[0].wires.size();
  const std::vector<Turn> turns = turns_of(coils, layouts, count / 3, 0.5, 3);
  ASSERT_EQ(turns.size(), count / 3);
  for (const std::size_t i : {std::size_t{0}, count / 3 - 1})
    for (std::size_t j = 0; j < 4; ++j) {
      const std::vector<Point>& w = layouts[j].wires;
      const Point middle = (1 / 3.0) * (w[3 * i] + w[3 * i + 1] + w[3 * i + 2]);
      EXPECT_LT(norm(turns[i].at[j].begin - coils[0].at[j].begin.place(middle)), 1e-12);
    }
  EXPECT_THROW(turns_of(coils, layouts, count / 3 + 1, 0.5, 3), Infeasible);
  EXPECT_THROW(turns_of(coils, layouts, 1, 0.5, 0), Infeasible);
}

}  // namespace
}  // namespace bahnwerk::winding
