#pragma once
/// What a joint plan of head and coarse axes is given.
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

struct JointTask {
  std::shared_ptr<const AxisPath> path;  ///< Cartesian, with as many axes as the machine
  CoarseFineMachine machine;
  std::vector<double> feeds;  ///< as those of a PathTask
  std::vector<bool> rests;
  std::vector<Rest> dwells = {};
};

}  // namespace bahnwerk
