#pragma once
/// What the drive has to bring about → member `load` of a result's details.
#include <nlohmann/json_fwd.hpp>

#include "core/plan/motion_law/load_plan.hpp"

namespace bahnwerk::api::motion_law {

/// Returns peaks with places, means, and columns over the master.
nlohmann::ordered_json load_result(const LoadPlan& load, const LawPlan& plan);

}  // namespace bahnwerk::api::motion_law
