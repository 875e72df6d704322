#pragma once
/// The coarse axes alone, within their own limits, under fine axes that stand in the middle: what every other plan is
/// compared with.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Plans the coarse axes alone, with limited jerk if the machine limits it. Cost: that of the planner of time laws.
/// Throws what it throws.
RedundancyResult plan_coarse_alone(const RedundancyTask& task, const RedundancyOptions& options, Progress progress);

}  // namespace bahnwerk
