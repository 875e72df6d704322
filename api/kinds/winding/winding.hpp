#pragma once
/// Kind "winding": JSON spec → core → result document. Angles are deg in documents and rad in core.
#include <nlohmann/json_fwd.hpp>

#include "api/kind.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk::api::winding_kind {

/// Most turns of one coil, by the proven bound of the slot, and of all coils together.
inline constexpr std::size_t max_turns = 2000, max_all_turns = 4000;
inline constexpr double max_setpoints = 20'000'000;

/// Reads a spec that passed its schema. Throws InvalidInput naming every fault, with places relative to the spec.
WindingRequest request(const nlohmann::json& spec);

}  // namespace bahnwerk::api::winding_kind
