#pragma once
/// The set of possible centres of wires of one radius in a usable area (all points at least `radius` from its
/// boundary), by its borders.
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

/// Pieces of the usable area's parallels that stay `radius` away from the whole boundary, and their corners. Unlike the
/// boundary of Region::inward(radius), which bounds areas, they include exact fits: a line where the usable area is as
/// wide as one wire (stored twice, once from either wall), a point where it is as large as one wire. Every extreme
/// point of the set is the end of a piece, on a piece or a corner. Accuracy: fit_margin.
struct CentreBorders {
  std::vector<Edge> pieces;
  std::vector<Point> corners;
};
/// Computes the borders. O(n log n) for n edges with few crossings of their parallels. Reports fraction 0 to
/// `progress`, if there is one.
CentreBorders centre_borders(const Region& usable_area, double radius, Progress progress = {});

/// Returns the part of `borders` that does not bound `centres`, the inward(radius) of that usable area: lines and
/// points where a wire fits exactly.
CentreBorders exact_fits(const CentreBorders& borders, const Region& centres, Progress progress = {});

}  // namespace bahnwerk::winding
