#pragma once
/// The axes of a machine along a tool's path, in the machine's best configuration.
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// Range and travel of an axis along a path.
struct AxisSpan {
  double lowest = 0, highest = 0;        ///< range of positions, in the axis' unit
  double lowest_at = 0, highest_at = 0;  ///< places of the extremes, mm along the path
  double travel = 0;                     ///< total variation of the axis
};

/// Returns the span of every axis. Extremes between the samples (eight per panel of the path's arc length) are found
/// where q′ changes its sign, to 1e-12 of the panel. Between two samples of one sign they are not
/// proven.
std::vector<AxisSpan> axis_spans(const AxisPath& path);

/// The axes of the chosen configuration along the path.
struct MachinePath {
  std::shared_ptr<const Kinematics> kinematics;
  std::shared_ptr<const KinematicAxisPath> axes;
  std::vector<AxisSpan> spans;
  double travel = 0;  ///< sum over all axes, in their units
};

/// Returns the path of the best of `configurations` (the arms of a robot, or a single machine): the one whose axes stay
/// in their ranges along the whole path, to 1e-9 of the unit, and travel least in total; the first one among equals.
/// `orientation` may be empty. Throws UnreachablePose if there is none, for the configuration that reaches furthest
/// along the path.
MachinePath machine_path(const std::shared_ptr<const Path>& tool, const std::shared_ptr<const Orientation>& orientation,
                         const std::vector<std::shared_ptr<const Kinematics>>& configurations);
/// Does the same; `tool` has to outlive the result.
inline MachinePath machine_path(const Path& tool, const std::shared_ptr<const Orientation>& orientation,
                                const std::vector<std::shared_ptr<const Kinematics>>& configurations) {
  return machine_path(borrowed(tool), orientation, configurations);
}

}  // namespace bahnwerk
