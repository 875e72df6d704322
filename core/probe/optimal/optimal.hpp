#pragma once
/// Method `optimal` of kind `probe_path`: a quartic spline in time whose steps and passing times are free, from coarse
/// to fine, as quick as limits and tube allow; never slower than rests at every point (core/probe/straight/stops.hpp).
///
/// Unknowns are the states at the points and at nodes between them, and the durations between (core/probe/optimal/
/// cell_basis.hpp, chain_solver.hpp); of dense points a few are chosen, and the motion is tried on all
/// (point_choice.hpp, passing.hpp). A straight that passes all points is kept to. Where the tube has no width the head
/// rests at every corner, and each straight between is planned along its direction. The result keeps every limit at all
/// times, by the convex-hull property. Objective `ripple`: the shortest motions for lower speeds, of which the one with
/// the least ripple that lasts at most `stretch` times as long as the quickest is taken; no motion is promised to have
/// less. The problem has local optima; the search starts from a slow motion through the points
/// (core/probe/optimal/start.hpp). Problems that differ by the scale of time alone have motions that differ by that
/// scale. Cost: linear in the points; a few hundred cells take 0.1 s, 10 000 points some seconds.
#include "core/base/progress.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// Plans the motion. Reports `progress` at every iteration; throws what it throws.
ProbeMotion plan_optimal(const ProbeProblem& problem, Progress progress);

}  // namespace bahnwerk
