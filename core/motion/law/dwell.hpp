#pragma once
/// Dwells in a time law. Planners only know that the motion stops at rests; how long it stays there is added here.
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

/// The law with a piece at rest for every dwell of the task that lasts, in their order. The law has to be at rest at
/// those places. The other pieces stay as they are, only later. O(pieces + rests). Progress stays at
/// the fraction `at`; throws what it throws.
TimeLaw with_dwells(TimeLaw law, const PathTask& task, Progress& progress, double at = 0);

/// Whether a piece is one of those: the motion stands.
inline bool dwells(const LawPiece& p) { return p.v == 0 && p.a == 0 && p.j == 0 && p.q == 0 && p.s_end == p.s; }

}  // namespace bahnwerk
