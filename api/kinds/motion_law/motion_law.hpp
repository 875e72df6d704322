#pragma once
/// Kind "motion_law": JSON spec → core → result document.
#include <nlohmann/json_fwd.hpp>

#include "api/kind.hpp"

namespace bahnwerk::api::motion_law {

void check(const nlohmann::json& spec);
PlannedJob plan(const nlohmann::json& spec, Progress& progress);

}  // namespace bahnwerk::api::motion_law
