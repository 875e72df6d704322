#pragma once
/// Parts of reading a spec of kind "winding"; each adds a fault for whatever is impossible.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <variant>
#include <vector>

#include "api/kinds/slot_input.hpp"
#include "core/machine/kinematics.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk::api::winding_kind {

using Faults = std::vector<InputFault>;

std::variant<winding::StatorPart, winding::RotorPart> part(const nlohmann::json& spec, Faults& faults);
/// The coils in the order in which they are wound; the part must be possible. Throws InvalidInput.
std::vector<winding::Coil> coils(const nlohmann::json& spec,
                                 const std::variant<winding::StatorPart, winding::RotorPart>& part);
/// The machine; of a robot one per arm that may be used.
std::vector<std::shared_ptr<const Kinematics>> machine(const nlohmann::json& spec, Faults& faults);

winding::LinkOptions links(const nlohmann::json& spec);
bool minimum_time(const nlohmann::json& spec);
winding::NeedleModel needle_model(const nlohmann::json& spec, const winding::Wire& wire);
winding::TensionModel tension_model(const nlohmann::json& spec, const winding::Wire& wire, Faults& faults);
winding::NeedleShape needle_shape(const nlohmann::json& spec);
winding::ToolPost tool(const nlohmann::json& spec, const winding::StatorHeads* heads, Faults& faults);
/// Method, profile and limits along the path.
void read_feed(const nlohmann::json& spec, WindingRequest& request, Faults& faults);

/// Faults of core name "slot" and "heads", which in this kind's document stand within "part".
InvalidInput relocated(const InvalidInput& error);

}  // namespace bahnwerk::api::winding_kind
