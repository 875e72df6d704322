#pragma once
/// Drawings of a probe path, as the source has them (SVG).
#include <string>

#include "core/plan/probe/probe_plan.hpp"

namespace bahnwerk {

class Progress;

/// The path with its tube and points: plan (x, y), and elevation (x, z) of a path in space. To scale.
std::string probe_path_drawing(const ProbePlan& plan);

/// Over time: deviation from the edge, speed, and acceleration, jerk and snap of every axis, with their limits dashed.
std::string probe_motion_drawing(const ProbePlan& plan, Progress& progress);

}  // namespace bahnwerk
