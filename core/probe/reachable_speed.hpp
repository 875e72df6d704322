#pragma once
/// Speeds that no motion through the points reaches.
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns the length of the polyline through the points, mm.
double polyline_length(const ProbeProblem& problem);

/// Returns a speed, mm/s, that no motion within the tube can reach from rest and brake from under the problem's limits.
double unreachable_speed(const ProbeProblem& problem);

/// Returns the problem with unreachable_speed() in place of a higher speed: problems that differ by such speeds are
/// one.
ProbeProblem with_reachable_speed(ProbeProblem problem);

}  // namespace bahnwerk::probe
