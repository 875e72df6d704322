#pragma once
/// A planned motion law → result document.
#include <nlohmann/json_fwd.hpp>

#include "api/kinds/motion_law/motion_law_input.hpp"

namespace bahnwerk::api::motion_law {

/// All of the result but its drawings.
nlohmann::ordered_json result_document(const MotionLawRequest& request, const LawPlan& plan);

}  // namespace bahnwerk::api::motion_law
