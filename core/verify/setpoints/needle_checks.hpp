#pragma once
/// Checks the needle's poses of a winding machine's setpoints by forward kinematics of every row.
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/machine/kinematics.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// Inputs of the check. The objects referred to have to outlive it.
struct NeedleInput {
  const KinematicAxisPath& path;    ///< required pose of the needle at each s
  const Kinematics& machine;        ///< the machine; forward() is independent of inverse(), which gave the axes
  const SetpointSource& setpoints;  ///< columns of every axis' name, x, y, z, phi, psi, s
  std::vector<double> shown;        ///< factor from each axis' unit to that of its column
};

/// Returns the check of every row by forward kinematics, with its tolerances:
///
/// `forward kinematics position`  mm   forward(axes) against the path at the row's s: 1e-6
/// `forward kinematics angle`     deg  φ (to whole turns) and ψ against the path: 1e-6
/// `setpoints pose`               mm   columns x, y, z, phi, psi against forward(axes): 1e-6; an angle counts as the
/// arc
///                                     of a point 100 mm away
///
/// Missing columns and values that are not numbers fail. About 0.5 µs per row.
std::unique_ptr<RowCheck> needle_row_check(const NeedleInput& input);

/// Returns the results after reading all rows for this check alone.
std::vector<Check> needle_checks(const NeedleInput& input, Progress progress);

}  // namespace bahnwerk
