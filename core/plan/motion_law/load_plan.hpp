#pragma once
/// What the drive of a planned motion law has to bring about, against its limits.
#include <string>

#include "core/cam_profile/drive_load.hpp"
#include "core/plan/motion_law/law_plan.hpp"

namespace bahnwerk {

struct LoadPlan {
  cam::DriveLoad load;
  cam::LoadLimits limits;
  cam::LoadFigures figures;
};

/// Computes the figures and appends the verifier's checks to `plan`. Throws InfeasibleAt, with places relative to the
/// spec, where a limit is broken.
LoadPlan plan_load(const cam::DriveLoad& load, const cam::LoadLimits& limits, LawPlan& plan, Progress progress);

/// Refuses by InfeasibleAt a law whose peaks, classical sections included, break the drive's limits in a given cycle;
/// appends a check for each limit.
void check_drive(const cam::DriveLimits& drive, LawPlan& plan);

/// Draws force or torque and power over the master, with the limit, and the plane of speed and torque.
std::string load_drawing(const LoadPlan& load, const LawPlan& plan);

}  // namespace bahnwerk
