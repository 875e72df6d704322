#pragma once
/// A proven upper bound on the number of wires in a usable area.
#include <cstddef>
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

/// Returns the bound: no layout that the verifier accepts has more wires of `radius` in the usable area with centres
/// `min_distance` apart, where both distances may lack verify_margin (core/winding/margin.hpp). Centres lie in the
/// usable area's inner part, hence in its convex hull K, of area A and boundary length P. In a compact convex set, also
/// a line (P twice its length) or a point, at most 2 A/(√3 d²) + P/(2 d) + 1 points are d or more apart [Oler: An
/// inequality in the geometry of numbers, Acta Math. 105, 1961]. Arcs of the hull are replaced by outer tangents,
/// within 1e-6 of area and length. Returns the largest std::size_t where the margin is not small against the wires.
std::size_t max_wires(const Region& usable_area, double radius, double min_distance, Progress progress = {});

/// Returns the corners of the convex hull, counterclockwise; of fewer than three points not on a line, all or the ends
/// of the line.
std::vector<Point> convex_hull(std::vector<Point> points);

}  // namespace bahnwerk::winding
