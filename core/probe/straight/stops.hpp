#pragma once
/// Rests at every point: the slowest motion that any method returns.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

class ProgressScope;

/// Rests at every point but for those in a row (straight_rows()). O(points). Throws what progress throws.
ProbeMotion plan_stops(const ProbeProblem& problem, Progress progress);
ProbeMotion plan_stops(const ProbeProblem& problem, ProgressScope& progress);
/// Returns that motion for rows as straight_rows() has them, without regard to the rounding of times that plan_stops()
/// sees to (core/probe/lasting_phases.hpp).
ProbeMotion write_stops(const ProbeProblem& problem, const std::vector<std::size_t>& row_end, ProgressScope& progress);
/// Returns the duration, s.
double stops_duration(const ProbeProblem& problem);

}  // namespace bahnwerk
