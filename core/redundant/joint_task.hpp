#pragma once
/// The input of the joint planner: path, machine, feeds and rests.
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

struct JointTask {
  std::shared_ptr<const AxisPath> path;  ///< Cartesian, with as many axes as the machine
  CoarseFineMachine machine;
  std::vector<double> feeds;      ///< per segment, mm/s, see PathTask
  std::vector<bool> rests;        ///< per segment: whether the motion rests at its begin
  std::vector<Rest> dwells = {};  ///< rests of given durations
};

}  // namespace bahnwerk
