#include "core/winding/slot/coil_sides.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::winding {
namespace {

TEST(CoilSides, HalvesHaveTheSlotsAreaTogether) {
  const Slot stator = make_slot(StatorSlot{});
  for (const Sharing how : {Sharing::beside, Sharing::layers}) {
    const SharedSlot half = shared(stator, how);
    EXPECT_NEAR(half.slot.usable_area.area(), stator.usable_area.area() / 2, 1e-6);
    EXPECT_NEAR(half.back.area(), stator.usable_area.area() / 2, 1e-6);
    EXPECT_EQ(half.slot.iron.area(), stator.iron.area());
  }
  EXPECT_LT(shared(stator, Sharing::beside).slot.usable_area.box().high.x, 1e-9) << "the left one";
  EXPECT_GT(shared(stator, Sharing::layers).slot.usable_area.box().low.y, 5) << "the upper one";
  const Slot rotor = make_slot(RotorSlot{});
  EXPECT_EQ(shared(rotor, Sharing::beside).slot.usable_area.area(), rotor.usable_area.area());
}

}  // namespace
}  // namespace bahnwerk::winding
