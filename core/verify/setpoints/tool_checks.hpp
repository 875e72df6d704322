#pragma once
/// Checks the tool of a machine that follows a contour through kinematics, by forward kinematics of every row.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/geometry/path/path.hpp"
#include "core/machine/kinematics.hpp"

namespace bahnwerk {

/// Inputs of the check. The objects referred to have to outlive it.
struct ToolInput {
  const Path& path;                 ///< the driven contour, in the document's coordinates
  double height;                    ///< mm, added to its z
  std::size_t coordinates;          ///< number of coordinates that the machine moves
  const Kinematics& machine;        ///< forward() is independent of inverse(), which gave the axes
  const SetpointSource& setpoints;  ///< columns q, vq, aq of every axis' name q; x, y, z; s and v
  std::vector<double> shown;        ///< factor from each axis' unit to that of its columns
};

/// Returns the check of every row. The tool's velocity and acceleration follow from forward() alone, by differences
/// over h = 0.005 mm of the path, at most 0.1 ms: with p(t) = forward(q + q̇ t + q̈ t²/2) they are
/// (p(h) − p(−h))/2h and (p(h) − 2 p(0) + p(−h))/h².
///
/// `forward kinematics position`      mm     p(0) against the contour at the row's s: 1e-6
/// `forward kinematics velocity`      mm/s   against the tangent times the row's v: 1e-5 v + 1e-5
/// `forward kinematics acceleration`  mm/s²  its component across the path against curvature · v²: 1e-5 of the whole
///                                           acceleration, 1e-5/mm · v² and 1e-2
/// `setpoints pose`                   mm     columns x, y, z against p(0): 1e-6
///
/// Missing columns and values that are not numbers fail. About 1 µs per row.
std::unique_ptr<RowCheck> tool_row_check(const ToolInput& input);

}  // namespace bahnwerk
