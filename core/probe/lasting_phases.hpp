#pragma once
/// Phases that last long beside the rounding of their times.
///
/// Times of a motion that lasts T s are rounded by up to ε T/2, so a phase of d s is longer or shorter than planned by
/// up to ε T, and what its snap or jerk adds up to is wrong by the fraction ε T/d. Where limits are so far apart that
/// an axis reaches its jerk or acceleration within a millionth of T, that exceeds the limit by more than a verifier
/// grants.
#include <functional>

#include "core/base/progress_scope.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns the problem with jerk and snap lowered until no axis reaches its acceleration or jerk in less than `phase`
/// s; what keeps it keeps the given problem.
ProbeProblem with_phases_of(double phase, ProbeProblem problem);

/// Returns `plan`, a motion of profile phases for `problem`, if its rounded times keep the limits. Otherwise returns
/// the quicker one of two motions that do: the plan, slowed, and what `plan_for` returns for the problem with phases of
/// 1e-6 of the plan's duration. Costs a few operations where limits cannot be blurred, else O(pieces), 10 µs each, and
/// the second plan.
ProbeMotion with_lasting_phases(const ProbeProblem& problem, ProbeMotion plan,
                                const std::function<ProbeMotion(const ProbeProblem&)>& plan_for,
                                ProgressScope& progress);

/// Returns whether rounding of times may blur phases of a motion for `problem` that lasts `duration` s.
bool phases_may_blur(const ProbeProblem& problem, double duration);

}  // namespace bahnwerk::probe
