#pragma once
/// What is judged about a law in closed form: path velocity against the feeds, rest, continuity, order and coverage.
#include <vector>

#include "core/verify/judge.hpp"
#include "core/verify/pulse.hpp"

namespace bahnwerk::verify {

/// Checks of the law against the path's joints and feeds, in the order that judge() documents. O(pieces + segments).
std::vector<Check> law_checks(const JudgeInput& input, Pulse& pulse);

}  // namespace bahnwerk::verify
