#pragma once
/// What a planner of time laws, and the bound on all of them, is given: where the axes go and what they may do.
#include <memory>
#include <utility>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

struct PathTask {
  const AxisPath& path;
  const Machine& machine;     ///< as many axes as the path has, in its order
  std::vector<double> feeds;  ///< per segment: speed of the tool, mm/s, infinite where not limited
  std::vector<bool> rests;    ///< per segment, whether the motion rests at its begin; and one for the end of the path
  std::vector<Rest> dwells = {};  ///< those that last, and others, by segment; `rests` holds at each of them
  double dwell() const {          ///< s, of all of them
    double seconds = 0;
    for (const Rest& rest : dwells) seconds += rest.seconds;
    return seconds;
  }
};

/// The first `axes` coordinates along a contour, which it shares. A planar one's third axis stands at its height.
inline std::shared_ptr<const AxisPath> contour_axes(std::shared_ptr<const Contour> contour, std::size_t axes) {
  const double height = contour->dimension < 3 ? contour->height : 0;
  const Path& tool = contour->path;
  return std::make_shared<const CartesianAxisPath>(std::shared_ptr<const Path>(std::move(contour), &tool), axes,
                                                   height);
}

/// Feeds, rests and dwells of a contour, whose own path `path` follows.
inline PathTask contour_task(const AxisPath& path, const Contour& contour, const Machine& machine) {
  return {path, machine, contour.feeds(), contour.rest_places(), contour.rests};
}

}  // namespace bahnwerk
