#pragma once
/// `active_set` over angles that may be chosen [Nolte 3]: a systematic grid over their ranges, then a pattern search
/// from its best places.
#include "core/base/progress.hpp"
#include "core/cam/active_set/active_set.hpp"

namespace bahnwerk::cam {

/// Solves a problem by the method `active_set`. With fixed angles this is solve_active_set(). Free angles take at most
/// 400 places of a grid (or of a seeded random choice if a grid of three per angle is larger), then a compass search
/// from the best three, steps halved down to 1e-6 of the ranges, 2000 laws at most. The choice is deterministic. Throws
/// as solve_active_set() does.
Expected<LawSolution, NoLaw> plan_active_set(const MotionLawProblem& problem, Progress progress);

}  // namespace bahnwerk::cam
