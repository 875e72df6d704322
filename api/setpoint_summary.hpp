#pragma once
/// What a result says of its setpoints, the same for every kind that has any.
#include <nlohmann/json_fwd.hpp>

#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

/// Count, duration, cycle time, and each column with its unit; name, unit and step of the independent variable where
/// it is not time.
nlohmann::ordered_json setpoint_summary(const SetpointSource& setpoints);

}  // namespace bahnwerk::api
