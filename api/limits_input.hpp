#pragma once
/// Limits as every kind writes them.
#include <nlohmann/json_fwd.hpp>

#include "core/machine/limits.hpp"

namespace bahnwerk::api {

/// Reads members `velocity`, `acceleration`, `jerk`, `snap` and `range` ([lowest, highest]) of `object` where they are
/// given and not null; `unit` is what one of the document's is in core, such as π/180 for degrees. What is not there
/// keeps its value. Which members a kind knows is for its schema to say.
void take_limits(const nlohmann::json& object, Limits& limits, double unit = 1);

/// Returns the limits that `object` gives; every other one is infinite.
Limits read_limits(const nlohmann::json& object, double unit = 1);

}  // namespace bahnwerk::api
