#pragma once
/// Random regions of lines and arcs, and slow independent answers about them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/region/fillet.hpp"
#include "core/geometry/region/region.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::test {

/// A star-shaped polygon about the origin, within 1.5 and 6 mm, some corners rounded.
inline Region random_region(Random& random) {
  const int corners = 4 + static_cast<int>(random.below(6));
  std::vector<Point> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + 0.8 * random.uniform()) / corners, reach = random.uniform(2.5, 6);
    points.push_back(reach * Point{std::cos(angle), std::sin(angle)});
  }
  std::vector<Edge> loop;
  for (std::size_t k = 0; k < points.size(); ++k) loop.push_back(line(points[k], points[(k + 1) % points.size()]));
  for (std::size_t k = loop.size(); k-- > 0;)
    if (random.chance(0.6)) round_corner(loop, k, random.uniform(0.1, 0.8));
  return Region(loop);
}

/// Points of the boundary, at most `step` apart.
inline std::vector<Point> sampled(const Region& region, double step) {
  std::vector<Point> points;
  for (const Edge& edge : region.edges()) {
    const int pieces = 1 + static_cast<int>(edge.length() / step);
    for (int k = 0; k < pieces; ++k) points.push_back(edge.at(static_cast<double>(k) / pieces));
  }
  return points;
}

/// Distance to the nearest sample, positive inside by the number of crossings of a ray.
inline double slow_distance(const std::vector<Point>& polygon, Point p) {
  double best = 1e300;
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    best = std::min(best, square_distance(a, p));
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return (inside ? 1 : -1) * std::sqrt(best);
}

}  // namespace bahnwerk::test
