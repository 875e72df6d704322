#pragma once
/// Lower bounds of the duration of every motion that is right for a probe problem.
#include "core/base/verification.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

class Progress;

/// Returns the sum of the least times between points, each proven by multipliers (core/verify/probe/edge_bound.hpp)
/// under the limits of all axes, the speed, the capsule of the edge and those of its neighbours, with rests at both
/// ends. Sums over every second, fourth … point, with capsules widened to hold the points left out, may prove more.
/// `gap` stays 0. Cost: about 20 ms a point for few points; some seconds in all for thousands, where single edges have
/// closed forms only and moves over several edges have multipliers.
Bound probe_bound(const ProbeProblem& problem, Progress& progress);

/// Returns the sum of least_time() (core/verify/probe/edge_times.hpp) over the edges: full speed along each, and the
/// closed forms of rests at both ends of the path and at corners without a tube. O(points), below 1 µs each.
Bound quick_probe_bound(const ProbeProblem& problem);

}  // namespace bahnwerk
