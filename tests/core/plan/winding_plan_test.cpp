// From a slot to the setpoints of a winding machine.
#include "core/plan/winding/winding_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/machine/horizontal_winder.hpp"
#include "core/machine/robot_winder.hpp"
#include "core/machine/vertical_winder.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

WindingRequest stator_request(std::size_t turns) {
  WindingRequest r;
  winding::StatorPart part;
  r.part = part;
  r.wire = *winding::standard_wire(0.9, 2);
  r.coils = {winding::coil_between(part, 0, 5)};
  r.turns = turns;
  r.model.pivot_limit = 0.2;
  return r;
}
WindingRequest rotor_request(std::size_t turns) {
  WindingRequest r;
  winding::RotorPart part;
  r.part = part;
  r.wire = *winding::standard_wire(0.9, 2);
  r.coils = {winding::coil_between(part, 0, 1)};
  r.turns = turns;
  return r;
}

void show(const char* what, const WindingPlan& p) {
  std::printf("%s: path %.1f mm, %zu pieces, wire %.1f mm, %.4f s (bound %.4f, gap %.3g), %zu rows, clearance %.3f, law "
              "pieces %zu\n",
              what, p.path_length, p.path.pieces.size(), p.wire_length, p.motion.duration, p.motion.bound.duration,
              p.motion.bound.gap, p.motion.setpoints->count(), p.clearance.minimum, p.motion.pieces);
  for (const Check& c : p.motion.verification.checks)
    if (!c.passed) std::printf("   failed: %s %g > %g %s at %g\n", c.name.c_str(), c.value, c.limit, c.unit.c_str(), c.at);
}

TEST(WindingPlan, Probe) {
  for (const bool stator : {true, false})
    for (const test::Winder& winder : test::winders())
      for (const FeedMethod feed : {FeedMethod::natural, FeedMethod::optimised}) {
        WindingRequest r = stator ? stator_request(2) : rotor_request(2);
        r.configurations = winder.configurations;
        r.feed = feed;
        SilentProgress progress;
        try {
          const clock_t t = clock();
          const WindingPlan plan = plan_winding(r, progress);
          show((winder.name + (stator ? " stator " : " rotor ") + name_of<FeedMethod>(feed, feed_methods)).c_str(), plan);
          std::printf("   %.2f s CPU\n", static_cast<double>(clock() - t) / CLOCKS_PER_SEC);
        } catch (const std::exception& e) {
          std::printf("%s: %s\n", winder.name.c_str(), e.what());
        }
      }
}

}  // namespace
}  // namespace bahnwerk
