#pragma once
/// Parts of the reader of kind "fill_factor".
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "api/slot/slot_input.hpp"

namespace bahnwerk::api::fill_factor {

/// Returns the wires of a spec that passed its schema; adds a fault for each invalid one.
std::vector<winding::Wire> wires(const nlohmann::json& spec, int grade, std::vector<InputFault>& faults);

}  // namespace bahnwerk::api::fill_factor
