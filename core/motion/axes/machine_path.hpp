#pragma once
/// The axes of a machine along a tool's path, in the configuration that suits it best.
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// Where an axis goes along a path.
struct AxisSpan {
  double lowest = 0, highest = 0;        ///< in the axis' unit
  double lowest_at = 0, highest_at = 0;  ///< mm along the path
  double travel = 0;                     ///< sum of all ways
};

/// Of every axis. Extremes between the samples (eight per panel of the path's arc length) are found where q′ changes
/// its sign, to 1e-12 of the panel; nothing is proven of what happens between two samples otherwise.
std::vector<AxisSpan> axis_spans(const AxisPath& path);

struct MachinePath {
  std::shared_ptr<const Kinematics> kinematics;
  std::shared_ptr<const KinematicAxisPath> axes;
  std::vector<AxisSpan> spans;
  double travel = 0;  ///< sum over all axes, in their units
};

/// Of `configurations` (the arms of a robot; or one machine alone) the one whose axes stay in their ranges, to 1e-9 of
/// the unit, all along the path and travel least in all; of equal ones the first.
/// `orientation` may be empty. Throws UnreachablePose if there is none: that of the configuration that gets furthest.
MachinePath machine_path(const std::shared_ptr<const Path>& tool, const std::shared_ptr<const Orientation>& orientation,
                         const std::vector<std::shared_ptr<const Kinematics>>& configurations);
/// `tool` has to outlive the result.
inline MachinePath machine_path(const Path& tool, const std::shared_ptr<const Orientation>& orientation,
                                const std::vector<std::shared_ptr<const Kinematics>>& configurations) {
  return machine_path(borrowed(tool), orientation, configurations);
}

}  // namespace bahnwerk
