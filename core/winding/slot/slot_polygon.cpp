#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/region/crossings.hpp"
#include "core/geometry/region/fillet.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/slot/slot_faults.hpp"

namespace bahnwerk::winding {
namespace {

/// Finds edges that meet elsewhere than at their common corners, or turn back there: the polygon intersects itself.
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

/// Returns the longest edge steeper than 45°, else the longest edge.
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

/// Returns the centroid of the outline's corners by the shoelace formula.
Point centroid(const Region& outline) {
  Point sum{};
  double twice = 0;
  const Point origin = outline.edges().front().from;
  for (const Edge& edge : outline.edges()) {
    const Point a = edge.from - origin, b = edge.to - origin;
    const double c = cross(a, b);
    twice += c, sum = sum + c * (a + b);
  }
  return origin + (1 / (3 * twice)) * sum;
}

/// Finds both ends of the opening on the outline. The slot is the part with the larger area: the mouth between the ends
/// may be drawn straight or as the bore's arc, which dips into the slot or, for a rotor, bulges out of it.
Opening opening_of(const Region& iron, const std::array<Point, 2>& ends, double liner) {
  constexpr double deepest_mouth = 0.5;  // largest dip of the mouth, relative to the opening's width: half a circle
  const double clear = distance(ends[0], ends[1]);
  if (clear < 1e-6) SlotFaults().stop("opening", "its ends are the same");
  for (const Point end : ends)
    if (std::abs(iron.distance(end)) > 1e-3)
      SlotFaults().stop("opening", "ends " + SlotFaults::mm(std::abs(iron.distance(end))) + " away from the outline");
  Opening opening{0.5 * (ends[0] + ends[1]), left_of(unit(ends[1] - ends[0])), clear, liner};
  if (dot(centroid(iron) - opening.middle, opening.into) < 0) opening.into = -opening.into;
  const auto depth = [&](double k) { return iron.distance(opening.middle + k * clear * opening.into); };
  bool leads = false;
  for (double k = 0.01; k <= deepest_mouth && !leads; k += 0.01) leads = depth(k) > 0;
  if (!leads)
    SlotFaults().stop("opening", "does not lead into the slot: from its middle no slot is met within half its width, " +
                                     SlotFaults::mm(clear / 2) +
                                     "; name the two ends of the mouth, where flanks or tooth tips end");
  return opening;
}

}  // namespace

Slot make_slot(const PolygonSlot& s, Progress progress) {
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
  slot.usable_area = slot.iron.inward(s.liner, progress);
  if (slot.usable_area.empty()) faults.stop("liner", "leaves no usable area");
  if (s.opening) slot.opening = opening_of(slot.iron, *s.opening, s.liner);
  const Point low = slot.iron.box().low;
  slot.tension_point = low - Point{4, 4};
  slot.flank_tension_point = low - Point{4, 0};
  return slot;
}

UprightSlot upright(const PolygonSlot& s, Progress progress) {
  const Slot slot = make_slot(s, progress);
  UprightSlot turned{s, {}};
  if (!slot.opening) {
    const Box& box = slot.iron.box();
    turned.drawn.origin = {0.5 * (box.low.x + box.high.x), box.low.y};
  } else {
    const Point up = -slot.opening->into, middle = slot.opening->middle;
    double lowest = 0;
    for (const Point p : s.points) lowest = std::min(lowest, dot(p - middle, up));
    turned.drawn = {middle + lowest * up, -left_of(up)};
    for (Point& p : *turned.slot.opening) p = {turned.drawn.foot(p).x, -lowest};
  }
  for (Point& p : turned.slot.points) p = turned.drawn.foot(p);
  return turned;
}

}  // namespace bahnwerk::winding
