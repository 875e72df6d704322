#pragma once
/// A finished motion of coarse and fine axes gets another time law [Bock chapter 5]: all axes go where they went, but
/// as fast as the first of their limits lets them.
///
/// The source follows the limit curve λ(t)² from sources to sinks (Algorithm 5.1). Here the motion is a path of 2 N
/// axes over its own time (timed_path.hpp), and the acceleration-limited planner of all machines drives it: the same
/// optimum, by passes over a grid, special points included. Where all axes stand (5.2.3) the head's speed is not what
/// limits the rate; it is capped at `fastest_rate` then. Dwells last as long as they did.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

inline constexpr double fastest_rate = 50;  ///< of the old time

/// Returns `found` with that law; itself, with a note, where that is no shorter. Limits are those of the task's
/// machine. Cost: that of the acceleration-limited planner over the pieces of both motions. Throws what the planner
/// throws.
RedundancyResult reparametrised(RedundancyResult found, const RedundancyTask& task, Progress& progress, double from,
                                double to);

}  // namespace bahnwerk
