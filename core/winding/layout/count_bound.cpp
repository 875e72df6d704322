#include "core/winding/layout/count_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/winding/centre_borders.hpp"
#include "core/winding/margin.hpp"

namespace bahnwerk::winding {
namespace {

/// Returns points whose convex hull contains the set: corners, ends of pieces and, for arcs, the corners of tangents
/// every 0.2°.
std::vector<Point> around(const CentreBorders& borders) {
  std::vector<Point> points = borders.corners;
  for (const Edge& edge : borders.pieces) {
    points.push_back(edge.from);
    points.push_back(edge.to);
    if (edge.straight() || edge.turn < 0) continue;
    const int pieces = 1 + static_cast<int>(edge.turn / 0.0035);
    const double stretch = 1 / std::cos(edge.turn / pieces / 2);
    for (int k = 0; k < pieces; ++k)
      points.push_back(edge.centre + stretch * (edge.at((k + 0.5) / pieces) - edge.centre));
  }
  return points;
}

}  // namespace

std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 2) return points;
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the begin of the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::size_t max_wires(const Region& usable_area, double radius, double min_distance, Progress progress) {
  constexpr double endless = 1e15;
  const double d = min_distance - verify_margin, inset = radius - verify_margin;
  if (d <= 100 * verify_margin || inset <= 0) return std::numeric_limits<std::size_t>::max();
  const std::vector<Point> hull = convex_hull(around(centre_borders(usable_area, inset, progress)));
  if (hull.empty()) return 0;
  double doubled = 0, length = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point next = hull[i + 1 == hull.size() ? 0 : i + 1];
    doubled += cross(hull[i] - hull[0], next - hull[0]);
    length += distance(hull[i], next);
  }
  const double most = doubled / (std::sqrt(3.0) * d * d) + length / (2 * d) + 1;
  return most < endless ? static_cast<std::size_t>(most) : std::numeric_limits<std::size_t>::max();
}

}  // namespace bahnwerk::winding
