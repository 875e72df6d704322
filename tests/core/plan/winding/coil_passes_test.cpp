#include "core/plan/winding/coil_passes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "tests/core/plan/winding/winding_plans.hpp"

namespace bahnwerk {
namespace {

TEST(CoilPasses, FollowTheCoilsOfTheDocument) {
  for (const bool stator : {true, false}) {
    WindingRequest r = stator ? stator_request(2) : rotor_request(2);
    r.feed = PlanningMethod::critical_points;
    r.coils = winding::repeated(r.coils.front(), stator ? 48 : 6, 2, 2, true);
    const WindingPlan p = planned(r);
    const CoilSlotInput input = coil_passes(r, p, *p.motion.setpoints);
    ASSERT_EQ(input.passes.size(), 8u);
    const double pitch =
        stator ? std::get<winding::StatorPart>(r.part).pitch() : std::get<winding::RotorPart>(r.part).pitch();
    const int slots = stator ? 5 : 1;
    // The second coil is wound the other way round, two slots farther.
    const int expected[] = {0, slots, 0, slots, 2 + slots, 2, 2 + slots, 2};
    for (std::size_t i = 0; i < 8; ++i) {
      const SlotPass& pass = input.passes[i];
      EXPECT_NEAR(pass.slot.middle, (expected[i] - (stator ? 0 : 0.5)) * pitch, 1e-12) << stator << i;
      EXPECT_NEAR(pass.slot.half, pitch / 2, 1e-15);
      const double wire =
          std::remainder(std::atan2(pass.wire_in.y, pass.wire_in.x) - pass.wire.middle, 2 * std::numbers::pi);
      EXPECT_LT(std::abs(wire), pass.wire.half) << stator << i;
      EXPECT_EQ(pass.wire_in.z > pass.wire_out.z, i % 2 == 0);
    }
    EXPECT_EQ(input.outside, stator);
    EXPECT_EQ(input.needle_length, r.needle.length);
  }
}

}  // namespace
}  // namespace bahnwerk
