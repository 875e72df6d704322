#pragma once
/// No motion that is right for a probe problem is shorter than this.
#include "core/base/verification.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

class Progress;

/// The sum of the least times between points, each proven by multipliers (core/verify/probe/edge_bound.hpp) under the
/// limits of all axes, the speed, the capsule of the edge and those of its neighbours; rests at both ends. Points in
/// between are also left out, by twos, fours …, where a wider capsule around the rest proves more. `gap` is left 0.
/// Cost: about 20 ms a point where they are few, some seconds in all where they are many: of thousands, single edges
/// have closed forms only, and moves over several edges the rest.
Bound probe_bound(const ProbeProblem& problem, Progress& progress);

/// Such a sum from closed forms of single edges alone: full speed along each, and where an end has to be a rest (both
/// ends of the path, corners without a tube) what acceleration, jerk and snap of each axis take. O(points), below 1 µs
/// each.
Bound quick_probe_bound(const ProbeProblem& problem);

}  // namespace bahnwerk
