#pragma once
/// The input of a planner of time laws, and of the bound on all of them: the path of the axes and their limits.
#include <memory>
#include <utility>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// A path and the limits along it. Path and machine have to outlive it.
struct PathTask {
  const AxisPath& path;
  const Machine& machine;     ///< limits of the path's axes, in its order
  std::vector<double> feeds;  ///< largest speed of the tool per segment, mm/s; infinite where not limited
  std::vector<bool>
      rests;  ///< whether the motion rests at the beginning of each segment; one more entry for the end of the path
  std::vector<Rest> dwells =
      {};                 ///< dwells in the order of their segments, also those of duration 0; `rests` is true at each
  double dwell() const {  ///< sum of all dwells, s
    double seconds = 0;
    for (const Rest& rest : dwells) seconds += rest.seconds;
    return seconds;
  }
};

/// Returns the first `axes` coordinates along a contour, which the path shares. The third axis of a planar contour is
/// constant at its height.
inline std::shared_ptr<const AxisPath> contour_axes(std::shared_ptr<const Contour> contour, std::size_t axes) {
  const double height = contour->dimension < 3 ? contour->height : 0;
  const Path& tool = contour->path;
  return std::make_shared<const CartesianAxisPath>(std::shared_ptr<const Path>(std::move(contour), &tool), axes,
                                                   height);
}

/// Returns the task with the feeds, rests and dwells of a contour, whose path `path` follows.
inline PathTask contour_task(const AxisPath& path, const Contour& contour, const Machine& machine) {
  return {path, machine, contour.feeds(), contour.rest_places(), contour.rests};
}

}  // namespace bahnwerk
