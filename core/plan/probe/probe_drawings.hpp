#pragma once
/// Drawings of a probe path, as the source has them (SVG).
#include <string>

#include "core/base/progress.hpp"
#include "core/plan/probe/probe_plan.hpp"

namespace bahnwerk {

/// Returns the path with its tube and points to scale: plan (x, y) and, in space, elevation (x, z).
std::string probe_path_drawing(const ProbePlan& plan);

/// Returns deviation from the edge, speed, and acceleration, jerk and snap of every axis over time, with limits dashed.
std::string probe_motion_drawing(const ProbePlan& plan, Progress progress);

}  // namespace bahnwerk
