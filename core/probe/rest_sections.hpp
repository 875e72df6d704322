#pragma once
/// Motions through the same points are exchanged where they rest.
#include <vector>

#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns the quickest motion that follows one of `plans` from each rest to the next one: the shortest path over the
/// points at which they rest (phases of kind rest). Of equally quick ones the first is taken. The plans pass all
/// points of the problem and have planned durations and joints. O(pieces).
ProbeMotion quickest_sections(const ProbeProblem& problem, std::vector<ProbeMotion> plans);

}  // namespace bahnwerk::probe
