#pragma once
/// Kind "fill_factor": JSON spec → core → result document.
#include <nlohmann/json_fwd.hpp>

#include "api/kind.hpp"
#include "core/plan/fill_plan.hpp"

namespace bahnwerk::api::fill_factor {

/// Most wires that one layout may have, by the proven bound.
inline constexpr std::size_t max_wires = 2000;  // whether they can be wound takes half a minute

/// Reads a spec that passed its schema. Throws InvalidInput naming every fault, with places relative to the spec.
FillRequest request(const nlohmann::json& spec, Progress* progress = nullptr);

}  // namespace bahnwerk::api::fill_factor
