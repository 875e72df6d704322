#pragma once
/// How many wires can be in a usable area at most: a proven bound.
#include <cstddef>
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

/// No layout that the verifier accepts has more wires of `radius` in the usable area whose centres are `min_distance`
/// apart: both distances may lack verify_margin (core/winding/margin.hpp). Centres lie in the usable area's inner part,
/// hence in its convex hull K, of area A and boundary length P; in a compact convex set, be it a line (P twice its
/// length) or a point, no more than 2 A/(√3 d²) + P/(2 d) + 1 points are d or more apart [Oler: An inequality in the
/// geometry of numbers, Acta Math. 105, 1961]. Arcs of the hull are replaced by tangents outside of it, within 1e-6 of
/// area and length. The largest std::size_t where the margin is not small against the wires.
std::size_t max_wires(const Region& usable_area, double radius, double min_distance, Progress* progress = nullptr);

/// Corners of the convex hull, counterclockwise; of fewer than three points not on a line, all or the ends of the line.
std::vector<Point> convex_hull(std::vector<Point> points);

}  // namespace bahnwerk::winding
