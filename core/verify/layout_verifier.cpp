#include "core/verify/layout_verifier.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/progress.hpp"
#include "core/verify/worst.hpp"
#include "core/winding/margin.hpp"

namespace bahnwerk {
namespace {

constexpr double rounding = winding::verify_margin;

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
  // The point is within the arc's angle if the turn from its middle is at most half of its turn.
  const Point middle = edge.at(0.5);
  const double mx = middle.x - edge.centre.x, my = middle.y - edge.centre.y;
  const double px = p.x - edge.centre.x, py = p.y - edge.centre.y;
  const double off = std::abs(std::atan2(mx * py - my * px, mx * px + my * py));
  return off > std::abs(edge.turn) / 2 ? ends : std::abs(std::hypot(px, py) - edge.radius);
}

/// Returns how far the wire extends over the boundary, mm; negative: clearance.
double beyond(const Region& usable_area, Point p, double radius) {
  double nearest = 1e300, turns = 0;
  for (const Edge& edge : usable_area.edges()) {
    nearest = std::min(nearest, distance_to(edge, p));
    turns += swept(edge, p);
  }
  const bool inside = std::abs(turns) > std::numbers::pi;
  return radius - (inside ? nearest : -nearest);
}

/// Asks `progress` once in a while.
class WorkCounter {
 public:
  explicit WorkCounter(Progress progress) : progress_(progress) {}
  /// `share` of the whole is done, `work` comparisons since the last call.
  void take(double share, std::size_t work) {
    work_ += work;
    if (work_ < 65536) return;
    work_ = 0;
    progress_.report("verification", share);
  }

 private:
  Progress progress_;
  std::size_t work_ = 65536;
};

/// 2 · radius less the least distance of two wires, or as little as that there are none within 2 · radius along x.
/// A NaN is passed on.
double deepest_overlap(std::span<const Point> wires, double radius, double share, WorkCounter& counter) {
  std::vector<Point> sorted(wires.begin(), wires.end());
  for (const Point& p : sorted)
    if (std::isnan(p.x) || std::isnan(p.y)) return std::numeric_limits<double>::quiet_NaN();
  std::sort(sorted.begin(), sorted.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  double least = 2 * radius;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    std::size_t k = i + 1;
    for (; k < sorted.size() && sorted[k].x - sorted[i].x < least; ++k)
      least = std::min(least, std::hypot(sorted[k].x - sorted[i].x, sorted[k].y - sorted[i].y));
    counter.take(share, k - i);
  }
  return 2 * radius - least;
}

void raise(Check& check, double value, double at) {
  // Not-a-number counts as worse than every number.
  if (value > check.value || std::isnan(value)) {
    check.value = value;
    check.at = at;
  }
  check.passed = check.value <= check.limit;
}

}  // namespace

Verification verify_layouts(const Region& usable_area, std::span<const LayoutToVerify> layouts, Progress progress) {
  constexpr Quantity wire_overlap{"overlap beyond what is allowed", CheckGroup::geometry, true},
      boundary_overlap{"overlap with the boundary", CheckGroup::geometry, true},
      wires_missing{"wires missing", CheckGroup::geometry, true};
  Verification verdict;
  const auto check = [&](const Checked& what, double limit) -> Check& {
    for (Check& c : verdict.checks)
      if (is(c, what.quantity, what.order, what.subject)) return c;
    verdict.checks.push_back(verify::make_check(what, limit, -1e300, 0, true));
    return verdict.checks.back();
  };
  WorkCounter counter(progress);
  double beyond_bound = -1e300, at_bound = 0;
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    const LayoutToVerify& layout = layouts[i];
    const double share = static_cast<double>(i) / static_cast<double>(layouts.size());
    const std::string name = layout.algorithm + (layout.region.empty() ? "" : ", " + layout.region);
    const Region& where = layout.usable_area ? *layout.usable_area : usable_area;
    double outside = -1e300;
    for (const Point& p : layout.wires) {
      counter.take(share, 16 * where.edges().size());
      const double over = beyond(where, p, layout.radius);
      if (over > outside || std::isnan(over)) outside = over;
    }
    const double overlap =
        layout.wires.size() < 2 ? -layout.overlap : deepest_overlap(layout.wires, layout.radius, share, counter);
    raise(check({wire_overlap, 0, "mm", name}, rounding), overlap - layout.overlap, layout.copper);
    raise(check({boundary_overlap, 0, "mm", name}, rounding), layout.wires.empty() ? 0 : outside, layout.copper);
    const auto count = static_cast<double>(layout.wires.size());
    if (layout.usable_area) {
      raise(check({wires_missing, 0, "1", name}, 0), std::abs(static_cast<double>(layout.count) - count),
            layout.copper);
    } else if (count - static_cast<double>(layout.bound) > beyond_bound) {
      beyond_bound = count - static_cast<double>(layout.bound);
      at_bound = layout.copper;
    }
  }
  if (!layouts.empty()) raise(check({{"bound", CheckGroup::bound}, 0, "1"}, 0), beyond_bound, at_bound);
  verdict.passed = std::all_of(verdict.checks.begin(), verdict.checks.end(), [](const Check& c) { return c.passed; });
  return verdict;
}

}  // namespace bahnwerk
