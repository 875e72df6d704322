// The spec of kind "winding" → WindingRequest.
#include "api/kinds/winding/winding_input.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/kinds/winding/winding.hpp"
#include "core/winding/layout/count_bound.hpp"

namespace bahnwerk::api::winding_kind {
namespace {

using nlohmann::json;
using winding::LayingRegions;
using winding::Slot;

std::string in_hand(std::size_t parallel) { return parallel > 1 ? " of " + std::to_string(parallel) + " wires" : ""; }

/// Adds faults for turns that no layout can have, by a proven bound, and for too many turns.
void check_turns(const WindingRequest& request, const Slot& slot, Faults& faults) {
  const double r = request.wire.radius();
  const std::size_t bound = winding::max_wires(slot.usable_area, r, 2 * r), coils = request.coils.size();
  const std::size_t parallel = request.parallel;
  if (bound == 0) {
    faults.push_back({{"wire"}, "does not fit into the slot"});
  } else if (parallel > bound) {
    faults.push_back({{"coil", "parallel"},
                      "are " + std::to_string(parallel) + " wires in hand; the slot has places for no more than " +
                          std::to_string(bound) + ", by a proven bound"});
  } else if (request.turns > bound / parallel) {
    faults.push_back({{"coil", "turns"},
                      "are " + std::to_string(request.turns) + in_hand(parallel) +
                          "; the slot has places for no more " + "than " + std::to_string(bound / parallel) +
                          ", by a proven bound"});
  } else if (bound > max_turns) {
    faults.push_back({{"wire"},
                      "is too thin for this slot: the bound is " + short_number(static_cast<double>(bound)) +
                          " turns, at most " + std::to_string(max_turns) + " are planned"});
  } else if (coils * (request.turns ? request.turns : bound / parallel) > max_all_turns && coils > 1) {
    faults.push_back(
        {{"coil", "repeat", "count"},
         "makes more than " + std::to_string(max_all_turns) + " turns in all: fewer coils or coil.turns are needed"});
  }
}

/// Slot and regions are computed to find what is impossible; planning computes them again.
void check_part(WindingRequest& request, const json& spec, Faults& faults) {
  const auto* stator = std::get_if<winding::StatorPart>(&request.part);
  const auto* rotor = std::get_if<winding::RotorPart>(&request.part);
  const Slot slot = stator ? checked_slot(*stator) : checked_slot(*rotor);
  request.coils = coils(spec, request.part);
  for (const winding::Coil& coil : request.coils)
    stator ? coil_regions(*stator, slot, coil) : coil_regions(*rotor, slot, coil);
  if (!(request.wire.outer > 0)) return;
  check_fit(spec, request, slot, faults);
  check_turns(request, slot, faults);
}

}  // namespace

InvalidInput relocated(const InvalidInput& error) {
  Faults faults = error.faults;
  for (InputFault& fault : faults) {
    auto& place = fault.place;
    if (place.empty()) continue;
    if (place.front() == "slot") place.insert(place.begin(), "part");
    if (place.front() == "heads") place.front() = "part";
  }
  return InvalidInput(std::move(faults));
}

WindingRequest request(const json& spec) {
  WindingRequest request;
  Faults faults;
  if (const auto wire = read_wire(spec["wire"], {"wire"}, spec.value("grade", 2), faults)) request.wire = *wire;
  request.part = part(spec, faults);
  take(spec["coil"], "turns", request.turns);
  take(spec["coil"], "parallel", request.parallel);
  request.configurations = machine(spec, faults);
  request.frame = pose_frame(spec);
  take(spec["machine"], "cycle_time", request.cycle_time);
  request.links = links(spec);
  request.minimum_time = minimum_time(spec);
  request.model = needle_model(spec, request.wire);
  request.tension = tension_model(spec, request.wire);
  request.bears = winding::breaking_pull(request.wire, wire_strength(spec));
  const json hold = spec.value("producible", json::object());
  take(hold, "friction", request.hold.friction);
  take(hold, "touch", request.hold.touch);
  request.needle = needle_shape(spec);
  request.swivel_length = swivel_length(spec);
  const auto* stator = std::get_if<winding::StatorPart>(&request.part);
  request.tool = tool(spec, stator ? &stator->heads : nullptr, faults);
  take(spec.value("needle", json::object()), "clearance", request.least_clearance);
  read_feed(spec, request, faults);
  request.interpolator =
      value_of<Interpolator>(spec.value("feed", json::object()).value("interpolator", "exact"), interpolators);
  take(spec, "temperature", request.temperature);
  request.max_setpoints = max_setpoints;
  if (request.needle.length < request.needle.width)
    faults.push_back({{"needle", "length"}, "is less than the needle's width"});
  try {
    check_part(request, spec, faults);
  } catch (const InvalidInput& error) {
    // Faults found while reading are not repeated in core's words.
    for (const InputFault& fault : relocated(error).faults)
      if (std::none_of(faults.begin(), faults.end(),
                       [&](const InputFault& known) { return known.place == fault.place; }))
        faults.push_back(fault);
  }
  // As many turns as the slot takes are counted when they are planned.
  if (const std::size_t turns = request.coils.size() * request.turns;
      request.law == FeedLaw::bspline && turns > max_spline_turns)
    faults.push_back({{"feed", "law"}, too_many_spline_turns(turns)});
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return request;
}

}  // namespace bahnwerk::api::winding_kind
