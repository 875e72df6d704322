#pragma once
/// A method that searches may find less where more is allowed. What keeps tighter values keeps the given ones, so plans
/// for a few tighter ones are candidates, too.
#include <vector>

#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// A speed that no motion within the tube reaches from rest, and still brakes from, under the problem's limits, mm/s.
double unreachable_speed(const ProbeProblem& problem);

/// The problem itself first, then with lower speeds, a narrower tube, lower limits. Speeds that cannot be reached are
/// one and the same problem; the lower ones are shares of that limit, so that they hardly depend on the given one.
std::vector<ProbeProblem> with_tighter(const ProbeProblem& problem);

}  // namespace bahnwerk::probe
