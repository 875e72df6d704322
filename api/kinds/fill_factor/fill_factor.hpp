#pragma once
/// Kind "fill_factor": reads its spec into the terms of core.
#include <nlohmann/json_fwd.hpp>

#include "api/kind.hpp"
#include "core/plan/fill_plan.hpp"

namespace bahnwerk::api::fill_factor {

/// Limit of the wires of a layout, compared with the proven bound of their number.
inline constexpr std::size_t max_wires = 2000;  // deciding whether they can be wound takes half a minute

/// Reads a spec that passed its schema. Throws InvalidInput naming every fault, with places relative to the spec.
FillRequest request(const nlohmann::json& spec, Progress progress = {});

}  // namespace bahnwerk::api::fill_factor
