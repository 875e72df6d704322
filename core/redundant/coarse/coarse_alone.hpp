#pragma once
/// The coarse axes alone, within their own limits, under fine axes that stand in the middle: what every other plan has
/// to be quicker than.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Plans the coarse axes alone, without limited jerk. Cost: that of the acceleration-limited planner. Throws what it
/// throws.
RedundancyResult plan_coarse_alone(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                   double at);

/// Returns `found`, or the coarse axes alone where they are quicker and stay within their ranges: then `gave_way` has
/// one row more, and `notes` a sentence.
RedundancyResult quicker_than_coarse_alone(RedundancyResult found, const RedundancyTask& task,
                                           const RedundancyOptions& options, Progress& progress, double at);

}  // namespace bahnwerk
