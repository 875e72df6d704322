#pragma once
/// The check of every setpoint of a probe path, in addition to that of any motion's axes.
#include <memory>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/verify/probe/probe_checks.hpp"

namespace bahnwerk {

/// Returns the check that compares in every row
///
/// `setpoints deviation`  mm     column `deviation` against the distance of the row's own position from the edge that
///                               is being passed: 64 ε of the largest coordinate
/// `setpoints speed`      mm/s   column `v` against the norm of the row's own velocity: 32 ε of it
///
/// Missing columns fail. Positions and derivatives are held to the motion by
/// core/verify/setpoints/motion_setpoint_checks.hpp. `input`, what it refers to and `setpoints` outlive the check.
std::unique_ptr<RowCheck> probe_row_check(const ProbeToVerify& input, const SetpointSource& setpoints);

}  // namespace bahnwerk
