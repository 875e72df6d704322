#pragma once
/// Drawings of a winding plan as SVG, shared by the service and the documentation, and its path for CAD.
#include <string>

#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Returns the needle's path about the part, isometric; the title names turns, length and duration.
std::string needle_path_drawing(const WindingRequest& request, const WindingPlan& plan);
/// Returns the curvature of the path of the first coil's first turn over its length.
std::string turn_curvature_drawing(const WindingPlan& plan);
/// Returns the needle's whole path as one rational B-spline in DXF (core/drawing/spline_dxf.hpp).
std::string needle_path_dxf(const WindingPlan& plan);

}  // namespace bahnwerk
