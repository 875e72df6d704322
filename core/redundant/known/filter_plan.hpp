#pragma once
/// Filtering in time [Bock 3.3]: the coarse axes get the head's motion through a low-pass, the fine axes what is left
/// of it, delayed by the filter's group delay. Here the head waits for that long at both ends instead, so the motion is
/// longer by twice the group delay, as in the source.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Plans with the taps and the cut-off of the options. Cost: some 5 to 30 plans of the head.
RedundancyResult plan_filter(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                             double from, double to);

}  // namespace bahnwerk
