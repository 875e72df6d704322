#include "core/geometry/region/fillet.hpp"

namespace bahnwerk {
namespace {

/// The edge moved to its left; an arc that has vanished keeps no radius.
Edge moved(Edge edge, double by) {
  const Point first = by * left_of(edge.direction(0)), last = by * left_of(edge.direction(1));
  edge.from += first;
  edge.to += last;
  if (!edge.straight()) edge.radius -= edge.turn > 0 ? by : -by;
  return edge;
}

}  // namespace

bool round_corner(std::vector<Edge>& loop, std::size_t i, double radius) {
  const std::size_t next = i + 1 == loop.size() ? 0 : i + 1;
  Edge &first = loop[i], &second = loop[next];
  if (radius <= 0 || cross(first.direction(1), second.direction(0)) <= 1e-12) return true;
  const Edge a = moved(first, radius), b = moved(second, radius);
  if ((!first.straight() && a.radius <= 0) || (!second.straight() && b.radius <= 0)) return false;
  for (const Meeting& m : meetings(a, b)) {
    if (m.first <= 0 || m.second >= 1) continue;
    const Point centre = a.at(m.first);
    const Edge before = first.part(0, m.first), after = second.part(m.second, 1);
    first = before;
    second = after;
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, arc_between(centre, before.to, after.from, true));
    return true;
  }
  return false;
}

}  // namespace bahnwerk
