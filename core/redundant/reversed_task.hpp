#pragma once
/// A task run from its end to its begin. Limits are the same in both directions of time, so what is planned for it is,
/// backwards in time, a plan of the task itself. Who plans both and takes the quicker one depends on no direction.
#include <optional>

#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// None where the path falls into other segments backwards. O(segments · degree²).
std::optional<RedundancyTask> reversed(const RedundancyTask& task);

/// A plan of the reversed task, backwards in time. `task`: not reversed. O(pieces).
RedundancyResult reversed(RedundancyResult found, const RedundancyTask& task);

}  // namespace bahnwerk
