#include "core/plan/winding/coil_passes.hpp"

#include <variant>

namespace bahnwerk {
namespace {

using winding::RotorPart;
using winding::StatorPart;

void set_ends(CoilSlotInput& input, const StatorPart& part) {
  input.low = 0, input.high = part.heads.stack;
  input.edge = winding::bore(part) / 2, input.outside = true;
}
void set_ends(CoilSlotInput& input, const RotorPart& part) {
  input.low = -part.heads.cap_base, input.high = part.heads.stack + part.heads.cap_base;
  input.edge = winding::outer_radius(part, winding::checked_slot(part)), input.outside = false;
}

SlotSector wires(const StatorPart&, SlotSector slot, bool) { return slot; }
/// A rotor's coil lies at its pole, which is ahead of the slot, counterclockwise, or behind it.
SlotSector wires(const RotorPart&, SlotSector slot, bool pole_ahead) {
  return {slot.middle + (pole_ahead ? 0.5 : -0.5) * slot.half, slot.half / 2};
}

}  // namespace

CoilSlotInput coil_passes(const WindingRequest& request, const WindingPlan& plan, const SetpointSource& setpoints) {
  CoilSlotInput input{.path = *plan.machine.axes, .setpoints = setpoints, .passes = {}};
  input.needle_length = request.needle.length;
  std::visit(
      [&](const auto& part) {
        set_ends(input, part);
        const std::size_t turns = plan.turns.size() / request.coils.size();
        for (std::size_t i = 0; i < plan.turns.size(); ++i) {
          const winding::Coil& coil = request.coils[i / turns];
          for (const bool second : {false, true}) {
            const winding::Passage& laid = plan.turns[i].at[second ? 2 : 0];
            const SlotSector slot{winding::slot_azimuth(part, coil.first + (second ? coil.span : 0)), part.pitch() / 2};
            input.passes.push_back({slot, wires(part, slot, (coil.span > 0) != second), laid.begin, laid.end});
          }
        }
      },
      request.part);
  return input;
}

}  // namespace bahnwerk
