#pragma once
/// Kind "winding": reads its spec into the terms of core. Angles are deg in documents and rad in core.
#include <nlohmann/json_fwd.hpp>

#include "api/kind.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk::api::winding_kind {

/// Limits of the turns of one coil, which the proven bound of the slot also limits, and of all coils together.
inline constexpr std::size_t max_turns = 2000, max_all_turns = 4000;
inline constexpr double max_setpoints = 20'000'000;

/// Reads a spec that passed its schema. Throws InvalidInput naming every fault, with places relative to the spec.
WindingRequest request(const nlohmann::json& spec);

}  // namespace bahnwerk::api::winding_kind
