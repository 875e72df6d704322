#pragma once
/// Motions whose rounding counts: pieces that are short beside the digits of their coordinates exceed limits that they
/// keep as planned.
#include "core/base/progress_scope.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// How many times as slow the motion has to be for its speed and the limits of its axes to hold at all times, from the
/// true peaks of its polynomials; `enough` where that is no more.
double needed_slowing(const ProbeProblem& problem, const ProbeMotion& motion, double enough, ProgressScope& progress);

/// The motion, as much slower as it exceeds a limit, with room for what being slowed further makes of its rounding.
ProbeMotion within_limits(const ProbeProblem& problem, ProbeMotion motion, ProgressScope& progress);

}  // namespace bahnwerk::probe
