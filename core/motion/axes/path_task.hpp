#pragma once
/// What a planner of time laws, and the bound on all of them, is given: where the axes go and what they may do.
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
};

/// Feeds and rests of a contour, whose own path `path` follows.
inline PathTask contour_task(const AxisPath& path, const Contour& contour, const Machine& machine) {
  return {path, machine, contour.feeds(), contour.rest_places()};
}

}  // namespace bahnwerk
