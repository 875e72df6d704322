#pragma once
/// Whether two polygons can be traversed together, neither ever going back, without getting further apart than a
/// radius: the decision of the Fréchet distance.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::verify {

enum class Traversal { possible, impossible, too_long };

/// From both first points to both last ones. [H. Alt, M. Godau: Computing the Fréchet distance between two polygonal
/// curves. Int. J. of Computational Geometry and Applications 5 (1995), section 3]: for two edges the pairs of points
/// that are near enough form a convex set, so what can be reached of the next edges' ends follows from what can be
/// reached of these edges' begins. Only cells that can be reached are looked at, at most `max_cells` of them; each
/// costs about 30 ns. Two polygons that follow each other have few per edge, coils inside the radius all pairs. A
/// unit of work of `scope` per cell.
Traversal traverse_within(const std::vector<Vec>& a, const std::vector<Vec>& b, double radius, std::size_t max_cells,
                          ProgressScope& scope);

}  // namespace bahnwerk::verify
