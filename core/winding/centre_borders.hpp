#pragma once
/// Where the centres of wires of one radius may lie in a usable area: the set of all points at least `radius` from its
/// boundary, by what bounds it.
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

/// Pieces of the usable area's parallels that keep `radius` from the whole boundary, and their corners. Unlike the
/// boundary of Region::inward(radius), which is one of areas, they include what an exact fit leaves: a line where the
/// usable area is as wide as one wire (twice then, once from either wall), a point where it is as large as one wire.
/// Every extreme point of the set is the end of a piece, on a piece or a corner. Accuracy: fit_margin.
struct CentreBorders {
  std::vector<Edge> pieces;
  std::vector<Point> corners;
};
/// O(n log n) for n edges with few crossings of their parallels. Reports fraction 0 to `progress`, if there is one.
CentreBorders centre_borders(const Region& usable_area, double radius, Progress* progress = nullptr);

/// What of `borders` does not bound `centres`, the inward(radius) of the same usable area: lines and points where a
/// wire fits exactly.
CentreBorders exact_fits(const CentreBorders& borders, const Region& centres, Progress* progress = nullptr);

}  // namespace bahnwerk::winding
