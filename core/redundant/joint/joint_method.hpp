#pragma once
/// The joint planner (joint.hpp) with the signature that all redundancy methods have (methods/method_table.hpp).
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Plans `task` with the joint planner. Throws what plan_joint() throws.
Expected<RedundancyResult, NoPlan> plan_joint_method(const RedundancyTask& task, const RedundancyOptions& options,
                                                     Progress progress);

}  // namespace bahnwerk
