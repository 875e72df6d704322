#pragma once
/// The independent check of every setpoint of a probe path.
#include <vector>

#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/verify/probe/probe_checks.hpp"

namespace bahnwerk {

class Progress;

/// Checks of core/verify/setpoints/motion_setpoint_checks.hpp, which hold positions and all derivatives shown of
/// all rows to the motion that was verified, and of every row
///
/// `setpoints deviation`  mm     column `deviation` against the distance of the row's own position from the edge that
///                               is being passed: 64 ε of the largest coordinate
/// `setpoints speed`      mm/s   column `v` against the norm of the row's own velocity: 32 ε of it
///
/// Missing columns fail. O(rows).
std::vector<Check> probe_setpoint_checks(const ProbeToVerify& input, const SetpointSource& setpoints,
                                         Progress& progress);

}  // namespace bahnwerk
