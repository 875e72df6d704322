#pragma once
/// Coils of the source's parts on machines that reach them.
#include "core/plan/winding/winding_plan.hpp"
#include "core/winding/fill.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {

inline WindingRequest stator_request(std::size_t turns) {
  WindingRequest r;
  winding::StatorPart part;
  r.part = part;
  r.wire = *winding::standard_wire(0.9, 2);
  r.coils = {winding::coil_between(part, 0, 5)};
  r.turns = turns;
  r.model.pivot_limit = 0.2;
  r.least_clearance = -100;  // whether the needle passes is another test's matter
  r.configurations = test::winders()[0].configurations;
  return r;
}
inline WindingRequest rotor_request(std::size_t turns) {
  WindingRequest r = stator_request(turns);
  winding::RotorPart part;
  r.part = part;
  r.coils = {winding::coil_between(part, 0, 1)};
  r.model.pivot_limit.reset();
  r.configurations = test::winders()[2].configurations;
  return r;
}

}  // namespace bahnwerk
