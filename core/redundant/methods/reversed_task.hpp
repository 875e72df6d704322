#pragma once
/// A redundancy task run from the end of its path to its begin. Limits are symmetric in time, so a plan of the reversed
/// task, run backwards, is a plan of the task. A planner that plans both directions and takes the quicker plan gives a
/// result that does not depend on the direction.
#include <optional>

#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Returns the reversed task; none if the reversed path has other segments. O(segments · degree²).
std::optional<RedundancyTask> reversed(const RedundancyTask& task);

/// Returns a plan `found` of the reversed task, run backwards, as a plan of `task` (the task that is not reversed).
/// O(pieces).
RedundancyResult reversed(RedundancyResult found, const RedundancyTask& task);

}  // namespace bahnwerk
