#pragma once
/// Points that lie in a row: straights that pass several points within their tolerances.
///
/// A straight from point i to point j passes the points between if it comes within a share of their allowed distance of
/// each, in order. The allowed distance is the smaller one of `tolerance` and what is left of `point_tolerance` after
/// points were taken for one. The points at which straights meet are a shortest path over the points, so they do not
/// depend on the order in which the points are given.
#include <cstddef>
#include <vector>

#include "core/probe/problem.hpp"

namespace bahnwerk::probe {

/// Returns per point the last point of its row; the last point has itself. Rows follow each other from the first point
/// on. They are the straights from rest to rest that take the shortest time, within the whole allowed distance. Up to
/// 60 points every choice of straights is compared; of more, those between the points that the longest straights from
/// either end lead to, and some between these. O(points · log points) where rows are short beside the path, some µs
/// each.
std::vector<std::size_t> straight_rows(const ProbeProblem& problem);

}  // namespace bahnwerk::probe
