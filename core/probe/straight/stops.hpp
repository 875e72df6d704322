#pragma once
/// Rests at every point: the slowest motion that any method returns.
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

class Progress;
class ProgressScope;

/// Rests at every point but for those in a row (straight_rows()). O(points). Throws what progress throws.
ProbeMotion plan_stops(const ProbeProblem& problem, Progress& progress);
ProbeMotion plan_stops(const ProbeProblem& problem, ProgressScope& progress);
/// Returns the duration, s.
double stops_duration(const ProbeProblem& problem);

}  // namespace bahnwerk
