#include "core/verify/layout_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace bahnwerk {
namespace {

using winding::Edge;
using winding::Point;

constexpr double rounding = 1e-9;  // mm

/// Angle of the direction from `p` to the edge's end, less that to its begin; arcs in steps of half a degree: a point
/// between an arc and its chord is far too near to the boundary anyway.
double swept(const Edge& edge, Point p) {
  const int steps = edge.straight() ? 1 : 1 + static_cast<int>(std::abs(edge.turn) / 0.0087);
  double sum = 0;
  Point a = edge.from - p;
  for (int k = 1; k <= steps; ++k) {
    const Point b = edge.at(static_cast<double>(k) / steps) - p;
    sum += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    a = b;
  }
  return sum;
}

double distance_to(const Edge& edge, Point p) {
  const double ends =
      std::min(std::hypot(p.x - edge.from.x, p.y - edge.from.y), std::hypot(p.x - edge.to.x, p.y - edge.to.y));
  if (edge.straight()) {
    const double dx = edge.to.x - edge.from.x, dy = edge.to.y - edge.from.y, length = std::hypot(dx, dy);
    const double along = ((p.x - edge.from.x) * dx + (p.y - edge.from.y) * dy) / length;
    if (along < 0 || along > length) return ends;
    return std::abs((p.x - edge.from.x) * dy - (p.y - edge.from.y) * dx) / length;
  }
  // Within the arc's angle if the turn from its middle is at most half of its turn.
  const Point middle = edge.at(0.5);
  const double mx = middle.x - edge.centre.x, my = middle.y - edge.centre.y;
  const double px = p.x - edge.centre.x, py = p.y - edge.centre.y;
  const double off = std::abs(std::atan2(mx * py - my * px, mx * px + my * py));
  return off > std::abs(edge.turn) / 2 ? ends : std::abs(std::hypot(px, py) - edge.radius);
}

/// By how much the wire reaches over the boundary, mm; negative: clearance.
double beyond(const winding::Region& room, Point p, double radius) {
  double nearest = 1e300, turns = 0;
  for (const Edge& edge : room.edges()) {
    nearest = std::min(nearest, distance_to(edge, p));
    turns += swept(edge, p);
  }
  const bool inside = std::abs(turns) > std::numbers::pi;
  return radius - (inside ? nearest : -nearest);
}

double deepest_overlap(std::span<const Point> wires, double radius) {
  double least = 1e300;
  for (std::size_t i = 0; i < wires.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double dx = wires[i].x - wires[k].x, dy = wires[i].y - wires[k].y;
      least = std::min(least, dx * dx + dy * dy);
    }
  return 2 * radius - std::sqrt(least);
}

void raise(Check& check, double value, double at) {
  // Not a number is worse than any.
  if (value > check.value || std::isnan(value)) {
    check.value = value;
    check.at = at;
  }
  check.passed = check.value <= check.limit;
}

}  // namespace

Verification judge_layouts(const winding::Region& room, std::span<const JudgedLayout> layouts, Progress& progress,
                           double progress_from, double progress_to) {
  Verification verdict;
  const auto check = [&](const std::string& name, const char* unit, double limit) -> Check& {
    for (Check& c : verdict.checks)
      if (c.name == name) return c;
    verdict.checks.push_back({name, unit, limit, -1e300, 0, true});
    return verdict.checks.back();
  };
  double done = 0;
  for (const JudgedLayout& layout : layouts) {
    const double share = done++ / static_cast<double>(layouts.size());
    progress.report("judging", progress_from + (progress_to - progress_from) * share);
    double outside = -1e300;
    for (const Point& p : layout.wires) {
      const double over = beyond(room, p, layout.radius);
      if (over > outside || std::isnan(over)) outside = over;
    }
    const double overlap = layout.wires.size() < 2 ? -layout.overlap : deepest_overlap(layout.wires, layout.radius);
    raise(check("overlap beyond what is allowed " + layout.algorithm, "mm", rounding), overlap - layout.overlap,
          layout.copper);
    raise(check("overlap with the boundary " + layout.algorithm, "mm", rounding), layout.wires.empty() ? 0 : outside,
          layout.copper);
    raise(check("count beyond the bound " + layout.algorithm, "1", 0),
          static_cast<double>(layout.wires.size()) - static_cast<double>(layout.bound), layout.copper);
  }
  verdict.passed = std::all_of(verdict.checks.begin(), verdict.checks.end(), [](const Check& c) { return c.passed; });
  return verdict;
}

}  // namespace bahnwerk
