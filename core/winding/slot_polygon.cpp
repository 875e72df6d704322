#include <algorithm>
#include <cmath>
#include <string>

#include "core/winding/crossings.hpp"
#include "core/winding/fillet.hpp"
#include "core/winding/slot.hpp"
#include "core/winding/slot_faults.hpp"

namespace bahnwerk::winding {
namespace {

/// Edges that meet elsewhere than at their common corners, or turn back there: the polygon crosses itself.
void check_simple(const std::vector<Edge>& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = i + 1 == loop.size() ? 0 : i + 1;
    const Point u = loop[i].direction(0), v = loop[next].direction(0);
    if (std::abs(cross(u, v)) < 1e-12 && dot(u, v) < 0)
      SlotFaults().stop("points", "the polygon turns back at point " + std::to_string(next));
  }
  if (const auto contact = self_contact(loop))
    SlotFaults().stop("points", "the edge that begins at point " + std::to_string(contact->second) +
                                    " meets the one that begins at point " + std::to_string(contact->first));
}

/// The longest edge steeper than 45°, else the longest.
double flank_of(const std::vector<Edge>& loop) {
  double best = -1, angle = 0;
  for (const Edge& edge : loop) {
    const Point d = edge.to - edge.from;
    const double rank = edge.length() + (std::abs(d.y) >= std::abs(d.x) ? 1e6 : 0);
    if (rank <= best) continue;
    best = rank;
    angle = std::atan2(d.y, d.x);
  }
  return angle;
}

}  // namespace

Slot make_slot(const PolygonSlot& s) {
  SlotFaults faults;
  std::vector<Point> points = s.points;
  if (points.size() > 1 && points.front() == points.back()) points.pop_back();
  if (points.size() < 3) faults.stop("points", "fewer than three corners");
  std::vector<Edge> loop;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point next = points[i + 1 == points.size() ? 0 : i + 1];
    if (distance(points[i], next) < 1e-6)
      faults.stop("points", "point " + std::to_string(i) + " and the next one are the same");
    loop.push_back(line(points[i], next));
  }
  check_simple(loop);
  Region outline(loop);
  if (std::abs(outline.area()) < 1e-6) faults.stop("points", "the polygon has no area");
  if (outline.area() < 0) {
    std::reverse(loop.begin(), loop.end());
    for (Edge& edge : loop) edge = edge.reversed();
  }
  Slot slot;
  slot.flank = flank_of(loop);
  if (s.corner_radius > 0)
    for (std::size_t i = loop.size(); i-- > 0;)
      if (!round_corner(loop, i, s.corner_radius)) faults.stop("corner_radius", "does not fit between its edges");
  slot.iron = Region(std::move(loop));
  slot.room = slot.iron.inward(s.liner);
  if (slot.room.empty()) faults.stop("liner", "leaves no room");
  const Point low = slot.iron.box().low;
  slot.pull = low - Point{4, 4};
  slot.flank_pull = low - Point{4, 0};
  return slot;
}

}  // namespace bahnwerk::winding
