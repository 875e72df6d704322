#pragma once
/// Lower bounds of the duration of every motion that is right for a probe problem.
#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// Returns the sum of the least times between points, each proven by multipliers (core/verify/probe/edge_bound.hpp)
/// under the limits of all axes, the speed, the capsule of the edge and those of its neighbours, with rests at both
/// ends. Sums over every second, fourth … point, with capsules widened to hold the points left out, may prove more.
/// `gap` stays 0. Multipliers are computed for all moves if there are at most `most_improved` edges; otherwise for
/// moves over several edges of which there are at most `most_improved` and 160, and single edges have the closed forms
/// of least_time() (core/verify/probe/edge_times.hpp). Cost: about 20 ms a move with multipliers, below 1 µs each
/// other.
Bound probe_bound(const ProbeProblem& problem, Progress progress, std::size_t most_improved = 1000);

}  // namespace bahnwerk
