#pragma once
/// `active_set` over angles that may be chosen [Nolte 3]: a systematic grid over their ranges, then a pattern search
/// from its best places.
#include "core/cam/solution.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::cam {

/// Fixed angles: solve_active_set(). Free ones: at most 400 places of a grid (or of a seeded random choice where a grid
/// of three per angle is larger), then a compass search from the best three, steps halved down to 1e-6 of the ranges, 2
/// 000 laws at most. Deterministic. Throws as solve_active_set() does; Infeasible where no place has a law.
LawSolution plan_active_set(const MotionLawProblem& problem, Progress& progress);

}  // namespace bahnwerk::cam
