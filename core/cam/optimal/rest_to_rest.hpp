#pragma once
/// The shortest cycle in closed form, where every section leads from rest to rest: constant jerk, constant
/// acceleration, constant velocity and back [Biagiotti, Melchiorri: Trajectory planning for automatic machines and
/// robots, 3.4].
#include <optional>

#include "core/cam/cam_law.hpp"

namespace bahnwerk::cam {

struct RestToRest {
  double duration = 0;  ///< s, of the law's cycle
  double bound = 0;     ///< s; no law has a shorter cycle. Equal to `duration` but for rounding where jerk is limited
  CamLaw law;           ///< seven pieces per section at most
};

/// Returns the law with the shortest cycle; none where a point does not rest or has an angle or a position in a range,
/// a joint asks for more than continuity 2, or the law leaves a limit of a section. Sections that need less than their
/// part of the cycle are stretched. Where jerk, or acceleration, is not limited, no law reaches the bound: it is
/// approached to 0.2 % with ramps.
std::optional<RestToRest> rest_to_rest(const MotionLawProblem& problem);

}  // namespace bahnwerk::cam
