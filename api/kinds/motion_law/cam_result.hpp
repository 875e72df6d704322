#pragma once
/// A planned mechanical cam → member `cam` of a result's details.
#include <nlohmann/json_fwd.hpp>

#include "core/plan/motion_law/cam_plan.hpp"

namespace bahnwerk::api::motion_law {

/// Returns figures, curves, and a job of kind "contour" along the profile (a barrel: along the groove's centre line in
/// the unrolled plane).
nlohmann::ordered_json cam_result(const CamPlan& plan);

}  // namespace bahnwerk::api::motion_law
