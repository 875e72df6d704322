#pragma once
/// Checks the setpoints of any motion: every row's axes against the motion that was verified. Where the axes follow a
/// path, setpoint_checks.hpp checks more.
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Inputs of the check. The objects referred to have to outlive it.
struct MotionSetpointInput {
  const Motion& motion;
  const Machine& machine;
  const SetpointSource& setpoints;
  std::string group = {};  ///< subject of all checks
};

/// Returns the check of every row. Row k is the state just after t = k · cycle time, found by a sweep through the
/// motion's pieces; the last row is the motion's final state. With ε, t's own rounding and the state x, v, a, j, s at
/// that time, T the piece's duration:
///
/// `setpoints count`         1         |rows − (duration / cycle time + 1)|; plus the number of missing columns: 0
/// `setpoints time`          s         (rows − 1) · cycle time against the motion's duration: 32 ε of it
/// `setpoints position`      mm        columns of the axes: 32 ε (|x| + |v| T + |a| T²/2 + |j| T³/6) + |v| ε t
/// `setpoints velocity`      mm/s      columns v: 32 ε (|v| + |a| T + |j| T²/2) + |a| ε t
/// `setpoints acceleration`  mm/s²     columns a: 32 ε (|a| + |j| T) + |j| ε t
/// `setpoints jerk`          mm/s³     columns j, where every axis has one: 32 ε |j| + |s| ε t
/// `setpoints snap`          mm/s⁴     columns s, where every axis has one: 32 ε |s|
/// `setpoints end`           mm        last row: axes against the motion's final state: 0
///
/// mm stands for the axis' unit. Each check reports the row that is closest to its tolerance; `at` is its time. A value
/// that is not a number fails.
std::unique_ptr<RowCheck> motion_row_check(const MotionSetpointInput& input);

/// Returns the results after reading all rows for this check alone, 1024 at a time. Reports every 2048 rows; passes its
/// exceptions on.
std::vector<Check> motion_setpoint_checks(const Motion& motion, const Machine& machine, const SetpointSource& setpoints,
                                          Progress progress, const std::string& group = {});

}  // namespace bahnwerk
