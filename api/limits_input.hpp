#pragma once
/// Reader of limits, which all kinds write alike.
#include <nlohmann/json_fwd.hpp>

#include "core/machine/limits.hpp"

namespace bahnwerk::api {

/// Reads the members `velocity`, `acceleration`, `jerk`, `snap` and `range` ([lowest, highest]) of `object` that are
/// present and not null; other limits keep their values. `unit` is the document's unit in core's, such as π/180 for
/// degrees. The kind's schema determines which members exist.
void take_limits(const nlohmann::json& object, Limits& limits, double unit = 1);

/// Returns the limits that `object` gives; every other one is infinite.
Limits read_limits(const nlohmann::json& object, double unit = 1);

}  // namespace bahnwerk::api
