#pragma once
/// The shape of an obstacle as a prism, for drawings in space. Lengths mm.
#include <cstddef>
#include <vector>

#include "core/geometry/region/region.hpp"
#include "core/winding/laying/laying_regions.hpp"

namespace bahnwerk::winding {

/// A plane section that extends from one height to another along the normal of its plane. The point (u, v) at height w
/// is origin + u x + v y + w z.
struct Solid {
  Vec3 origin{}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< orthonormal, z = x × y
  std::vector<Point> outline;             ///< counterclockwise and closed; empty: the section has no outer edge
  std::vector<std::vector<Point>> holes;  ///< clockwise and closed
  double from = 0, to = 0;
};

/// Appends the points of an edge after its first one; an arc becomes chords within `tolerance` mm of it.
void append_chords(const Edge& edge, double tolerance, std::vector<Point>& line);

/// Returns the edges of a region without the longest arc about `axis`, in their order from the end of that arc: the
/// line of one slot or pole, which its neighbours continue.
std::vector<Edge> open_edges(const Region& region, Point axis);

/// Returns the closed line round a part that `line` and its copies, `count` in all and each `pitch` rad after the one
/// before, make with arcs about the origin between them. `line` runs counterclockwise about the origin.
std::vector<Point> closed_round(const std::vector<Point>& line, int count, double pitch, double tolerance);

}  // namespace bahnwerk::winding
