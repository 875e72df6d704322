#pragma once
/// Parts of the reader of kind "winding"; each adds a fault for whatever is impossible.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <variant>
#include <vector>

#include "api/slot/slot_input.hpp"
#include "core/machine/kinematics.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk::api::winding_kind {

using Faults = std::vector<InputFault>;

std::variant<winding::StatorPart, winding::RotorPart> part(const nlohmann::json& spec, Faults& faults);
/// Returns the coils in the order in which they are wound; the part must be possible. Throws InvalidInput.
std::vector<winding::Coil> coils(const nlohmann::json& spec,
                                 const std::variant<winding::StatorPart, winding::RotorPart>& part);
/// Returns the machine; for a robot one per arm that may be used.
std::vector<std::shared_ptr<const Kinematics>> machine(const nlohmann::json& spec, Faults& faults);

/// Returns the position and rotation of the part's coordinates in the machine's.
PoseFrame pose_frame(const nlohmann::json& spec);
/// Returns the distance from the swivel's axis to the needle's tip, mm.
double swivel_length(const nlohmann::json& spec);

winding::LinkOptions links(const nlohmann::json& spec);
bool minimum_time(const nlohmann::json& spec);
winding::NeedleModel needle_model(const nlohmann::json& spec, const winding::Wire& wire);
winding::TensionModel tension_model(const nlohmann::json& spec, const winding::Wire& wire);
/// Returns the tensile strength of the wire's copper, N/mm².
double wire_strength(const nlohmann::json& spec);
/// Returns the requested tension of the wire, N; by default a tenth of its breaking force.
double wire_force(const nlohmann::json& spec, const winding::Wire& wire);
/// Adds a fault where wire, needle, pull or winding tools do not fit each other or the part with the slot `slot`, so
/// that no plan can exist. The wire must be known.
void check_fit(const nlohmann::json& spec, const WindingRequest& request, const winding::Slot& slot, Faults& faults);
winding::NeedleShape needle_shape(const nlohmann::json& spec);
winding::ToolPost tool(const nlohmann::json& spec, const winding::StatorHeads* heads, Faults& faults);
/// Reads method, profile and limits along the path.
void read_feed(const nlohmann::json& spec, WindingRequest& request, Faults& faults);

/// Returns the faults with the places "slot" and "heads" of core moved to "part", where this kind's document has them.
InvalidInput relocated(const InvalidInput& error);

}  // namespace bahnwerk::api::winding_kind
