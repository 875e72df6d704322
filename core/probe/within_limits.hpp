#pragma once
/// Limits of a motion as it is written: rounding makes pieces that are short beside the digits of their coordinates
/// exceed limits that they keep as planned.
#include "core/base/progress_scope.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns the factor by which the motion has to be slowed for its speed and the limits of its axes to hold at all
/// times, from enclosures of its polynomials' peaks to 1e-10; `enough` if that is larger. O(pieces), some µs each.
double needed_slowing(const ProbeProblem& problem, const ProbeMotion& motion, double enough, ProgressScope& progress);

/// Returns the motion, slowed by 1.5 to 3 times of what it exceeds limits by, so that it keeps them when slowed further
/// and rounded again, too.
ProbeMotion within_limits(const ProbeProblem& problem, ProbeMotion motion, ProgressScope& progress);

}  // namespace bahnwerk::probe
