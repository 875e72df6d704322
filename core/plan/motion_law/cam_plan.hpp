#pragma once
/// The mechanical cam of a planned motion law: radius, figures, curves, verified.
#include <optional>
#include <vector>

#include "core/cam_profile/cam_figures.hpp"
#include "core/geometry/spline/nurbs_path.hpp"
#include "core/plan/motion_law/law_plan.hpp"

namespace bahnwerk {

struct CamPlan {
  cam::CamGeometry geometry;
  cam::CamFigures figures;
  std::optional<cam::LeastRadius> least;  ///< for the pressure angle and the profile's radius, where one is limited
  NurbsPath profile, pitch;               ///< over the cam's angle, deg; a barrel's in the unrolled plane, mm
  std::optional<NurbsPath> other_flank;   ///< second flank of a barrel's groove
  std::vector<cam::CamPlace> places;      ///< over one turn, a quarter of a degree apart at most, for drawings
};

/// Makes the cam of a law that closes, and appends the verifier's checks to `plan`. Throws InfeasibleAt, with places
/// relative to the spec, where the cam is undercut or its pressure angle too large: it names the angle and what keeps
/// the limit; where the follower does not reach; where velocities jump.
CamPlan plan_cam(const cam::CamGeometry& geometry, LawPlan& plan, Progress progress);

}  // namespace bahnwerk
