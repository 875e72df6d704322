#pragma once
/// Member `cam` of a motion law's spec → geometry of a mechanical cam.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

#include "core/base/errors.hpp"
#include "core/cam/problem.hpp"
#include "core/cam_profile/cam_geometry.hpp"

namespace bahnwerk::api::motion_law {

/// Returns the cam of a spec that passed its schema; none if it has no `cam`. Appends faults: members that the type of
/// follower lacks or has no use for, a master that is no turn.
std::optional<cam::CamGeometry> cam_geometry(const nlohmann::json& spec, const cam::MotionLawProblem& problem,
                                             std::vector<InputFault>& faults);

}  // namespace bahnwerk::api::motion_law
