#pragma once
/// The filter method [Bock 3.3]: the coarse axes follow the head's motion through a low-pass filter, and the fine axes
/// make up for the difference, with a delay of one group delay. This implementation lets the head wait for one group
/// delay at both ends instead, so the motion lasts two group delays longer, as in the source.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Plans with the options' `taps` and `cutoff`. Cost: 5 to 30 plans of the head.
/// Throws as search_reference() does.
Expected<RedundancyResult, NoPlan> plan_filter(const RedundancyTask& task, const RedundancyOptions& options,
                                               Progress progress);

}  // namespace bahnwerk
