#pragma once
/// The decision problem of the Fréchet distance: whether two polygons can be traversed together, both forwards only,
/// within a radius.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::verify {

/// The answer; too_long: more cells than allowed would have to be evaluated.
enum class Traversal { possible, impossible, too_long };

/// Traverses from both first points to both last ones [H. Alt, M. Godau: Computing the Fréchet distance between two
/// polygonal curves. Int. J. of Computational Geometry and Applications 5 (1995), section 3]: for two edges the pairs
/// of points that are near enough form a convex set, so the reachable part of the next edges' ends follows from that of
/// these edges' beginnings. Only reachable cells are evaluated, at most `max_cells` of them; each costs about 30 ns.
/// Two polygons that follow each other have few reachable cells per edge; in coils smaller than the radius every
/// pair of edges is one. Each cell is a unit of
/// work of `progress`.
Traversal traverse_within(const std::vector<Vec>& a, const std::vector<Vec>& b, double radius, std::size_t max_cells,
                          ProgressScope& progress);

}  // namespace bahnwerk::verify
