#pragma once
/// The joint planner (core/redundant/joint.hpp) as one of the redundancy methods.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Throws what plan_joint() throws.
RedundancyResult plan_joint_method(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                   double from, double to);

}  // namespace bahnwerk
