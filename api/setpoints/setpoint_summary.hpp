#pragma once
/// The summary of setpoints in the result of every kind that has any.
#include <nlohmann/json_fwd.hpp>

#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

/// Returns count, duration, cycle time, and each column with its unit; also name, unit and step of the independent
/// variable if that is not time.
nlohmann::ordered_json setpoint_summary(const SetpointSource& setpoints);

}  // namespace bahnwerk::api
