#pragma once
/// Dwells in a time law. Planners only know that the motion stops at rests; the duration of each stop is added here.
#include "core/base/progress.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Returns the law with a piece at rest for every dwell of positive duration, in their order. The law has to be at rest
/// at these places. The other pieces are only shifted in time. O(pieces + rests). Passes exceptions of `progress` on.
TimeLaw with_dwells(TimeLaw law, const PathTask& task, Progress progress);

/// Returns whether a piece is a dwell.
inline bool dwells(const LawPiece& p) { return p.v == 0 && p.a == 0 && p.j == 0 && p.snap == 0 && p.s_end == p.s; }

}  // namespace bahnwerk
