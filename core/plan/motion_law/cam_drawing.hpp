#pragma once
/// Drawings of a mechanical cam: SVG and DXF.
#include <string>

#include "core/plan/motion_law/cam_plan.hpp"

namespace bahnwerk {

/// Draws the profile, the pitch curve and the base circle (a barrel: both flanks of the unrolled groove), with the
/// follower where the pressure angle is largest and where the profile's radius of curvature is least; below it both
/// over the cam's angle.
std::string cam_drawing(const CamPlan& plan);
/// Returns the profile, or both flanks of a groove, as DXF splines in mm on the layer "cam".
std::string cam_dxf(const CamPlan& plan);

}  // namespace bahnwerk
