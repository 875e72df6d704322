#pragma once
/// Parts of reading a spec of kind "winding"; each adds a fault for whatever is impossible.
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
/// The coils in the order in which they are wound; the part must be possible. Throws InvalidInput.
std::vector<winding::Coil> coils(const nlohmann::json& spec,
                                 const std::variant<winding::StatorPart, winding::RotorPart>& part);
/// The machine; of a robot one per arm that may be used.
std::vector<std::shared_ptr<const Kinematics>> machine(const nlohmann::json& spec, Faults& faults);

/// Where the part's coordinates stand in the machine's.
PoseFrame pose_frame(const nlohmann::json& spec);
/// From the swivel's axis to the needle's tip, mm.
double swivel_length(const nlohmann::json& spec);

winding::LinkOptions links(const nlohmann::json& spec);
bool minimum_time(const nlohmann::json& spec);
winding::NeedleModel needle_model(const nlohmann::json& spec, const winding::Wire& wire);
winding::TensionModel tension_model(const nlohmann::json& spec, const winding::Wire& wire);
/// Tensile strength of the wire's copper, N/mm².
double wire_strength(const nlohmann::json& spec);
/// The tension that the wire shall have, N; a tenth of what it bears where the document leaves it open.
double wire_force(const nlohmann::json& spec, const winding::Wire& wire);
/// Whether wire, needle, pull and winding tools fit each other and the part, whose slot is `slot`: what no plan could
/// do is refused where the document says it. The wire must be known.
void check_fit(const nlohmann::json& spec, const WindingRequest& request, const winding::Slot& slot, Faults& faults);
winding::NeedleShape needle_shape(const nlohmann::json& spec);
winding::ToolPost tool(const nlohmann::json& spec, const winding::StatorHeads* heads, Faults& faults);
/// Method, profile and limits along the path.
void read_feed(const nlohmann::json& spec, WindingRequest& request, Faults& faults);

/// Faults of core name "slot" and "heads", which in this kind's document stand within "part".
InvalidInput relocated(const InvalidInput& error);

}  // namespace bahnwerk::api::winding_kind
