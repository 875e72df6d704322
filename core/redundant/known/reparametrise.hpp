#pragma once
/// Reparametrisation of a finished motion of coarse and fine axes [Bock chapter 5, the afterburner]: the axis paths
/// stay as they are, and a new time law makes them as fast as the limits allow.
///
/// The source integrates along the limit curve λ(t)² from sources to sinks (Algorithm 5.1). This implementation takes
/// the motion as a path of 2 N axes over its own time (timed_path.hpp) and plans it with the acceleration-limited
/// planner, whose forward and backward passes over a grid find the same optimum, singular points included. Where all
/// axes stand (5.2.3) nothing limits the rate, so it is capped at `fastest_rate`. Dwells keep their durations.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

inline constexpr double fastest_rate = 50;  ///< largest rate dt_old/dt_new

/// Returns `found` with the new time law under the limits of the task's machine, or `found` unchanged with a note if
/// that is no shorter. Cost: the acceleration-limited planner over the pieces of both motions. Throws what that planner
/// throws.
RedundancyResult reparametrised(RedundancyResult found, const RedundancyTask& task, Progress progress);

}  // namespace bahnwerk
