#pragma once
/// The speeds of the turns by dynamic programming over candidates per point.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/arcs/turn_path.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns the quickest choice of speeds for turns between `directions`, one per edge of the problem. Candidates at a
/// point are 0, the largest speed that the tube admits, that can be reached from the start and braked from to the end,
/// and a geometric series below the largest one of all points, which neighbours share: a nominal speed that cannot be
/// reached changes nothing. Where `near`, an earlier choice (or null), turns, they are its speed and those up to the
/// fraction `width` about it, the speeds of its neighbours, the largest speed. A row, `row_end` as straight_rows() has
/// it, may be passed as one straight from rest to rest. O(points · candidates²), 0.5 µs each.
TurnSpeeds choose_speeds(const ProbeProblem& problem, const std::vector<std::size_t>& row_end,
                         const std::vector<Vec>& directions, const TurnSpeeds* near, double width,
                         ProgressScope& progress);

}  // namespace bahnwerk::probe
