#include "core/winding/laying/windable.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

/// 10 mm wide and deep, open by `clear` in the middle of its upper side.
Slot open_slot(double clear) {
  PolygonSlot slot{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  slot.opening = std::array{Point{5 - clear / 2, 10}, Point{5 + clear / 2, 10}};
  return make_slot(slot);
}

Windable verdict(const Slot& slot, const std::vector<Point>& wires, std::optional<Needle> needle = std::nullopt) {
  const Layout layout{wires, {}};
  return windable({slot, 1, layout, {5, -1e9}, needle}, {}, silent);
}

/// Two wires loose on a wide base, with a gap between them: the third drives them apart.
const std::vector<Point> loose{{3.1, 1}, {6.9, 1}, {5, 1 + std::sqrt(4 - 3.61)}};

TEST(Windable, WiresBeforeTheOneThatPushesAnotherOutHold) {
  const Windable all = verdict(open_slot(4), loose);
  ASSERT_TRUE(all.producible.first);
  EXPECT_EQ(all.producible.first->laid, 2u);
  EXPECT_EQ(all.most(), 2u);
  EXPECT_TRUE(all.can_be_wound(2));
  EXPECT_FALSE(all.can_be_wound(3));
  EXPECT_FALSE(all.producible_among(2).first) << "what a third wire does is not asked";
  EXPECT_TRUE(all.producible_among(3).first);
  const Windable held = verdict(open_slot(4), {{1, 1}, {3, 1}});
  EXPECT_EQ(held.most(), 2u);
  EXPECT_TRUE(held.can_be_wound(2));
}

TEST(Windable, NothingIsWoundPastAnOpeningThatIsTooNarrow) {
  const Windable wire = verdict(open_slot(1.9), {{1, 1}});
  EXPECT_EQ(wire.most(), 0u);
  EXPECT_FALSE(wire.can_be_wound(1));
  EXPECT_TRUE(wire.can_be_wound(0));
  ASSERT_EQ(wire.blocked_among(1).size(), 1u);
  EXPECT_EQ(wire.blocked_among(1)[0].part, Obstruction::Part::wire);
  EXPECT_EQ(verdict(open_slot(4), {{1, 1}}, Needle{2}).blocked_among(1).at(0).part, Obstruction::Part::bore);
  EXPECT_EQ(verdict(open_slot(4), {{1, 1}}, Needle{4.2}).blocked_among(1).at(0).part, Obstruction::Part::needle);
  EXPECT_EQ(verdict(open_slot(4), {{1, 1}}, Needle{2.5}).most(), 1u);
}

TEST(Windable, AWireWithoutAWayEndsTheTurnsBeforeIt) {
  // A row across the slot, then a wire below it.
  std::vector<Point> wires{{1, 5}, {9, 5}, {3, 5}, {7, 5}, {5, 5}, {1, 1}};
  const Windable all = verdict(open_slot(4), wires, Needle{2.5});
  ASSERT_EQ(all.blocked.size(), 1u);
  EXPECT_EQ(all.blocked[0].part, Obstruction::Part::channel);
  EXPECT_EQ(all.blocked[0].wire, 5u);
  EXPECT_TRUE(all.blocked_among(5).empty());
  EXPECT_EQ(all.blocked_among(6).size(), 1u);
  EXPECT_LE(all.most(), 5u);
}

}  // namespace
}  // namespace bahnwerk::winding
