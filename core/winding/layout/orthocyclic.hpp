#pragma once
/// Orthocyclic layout: every wire on one triangular lattice [Herrmann 4.2.1, Algorithm 4.1; Bickel].
#include "core/base/progress.hpp"
#include "core/geometry/region/region.hpp"
#include "core/winding/layout/layout.hpp"

namespace bahnwerk::winding {

/// The first wire lies at the place nearest to the attraction point `tension_point` (4.1). Rows run along `angle`, rad
/// against x: 0 for layers on the base, the flank's direction for layers on the flank (4.2). Further rows are the
/// neighbours of the last one at 60° (4.3). Every point of that lattice that is at least `radius` from the boundary has
/// a wire, also points beyond a gap in a row and rows on the other side of the first. Order: rows by their number of
/// steps from the first, the one to the left of `angle` before its mirror image; within a row from the wire beside the
/// first one outwards, along `angle` before against it. Accuracy 1e-9 mm as in core/winding/layout/sites.hpp. O(area /
/// radius²) distances to the boundary.
Layout orthocyclic(const Region& usable_area, double radius, Point tension_point, double angle, Progress progress);

}  // namespace bahnwerk::winding
