#include "core/winding/layout/orthocyclic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/progress.hpp"
#include "core/winding/layout/sites.hpp"

namespace bahnwerk::winding {
namespace {

/// Returns the least and greatest extent of the usable area's box along a unit vector, from `origin`.
struct Extent {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
};
Extent extent(const Box& box, Point origin, Point along) {
  Extent found;
  for (const double x : {box.low.x, box.high.x})
    for (const double y : {box.low.y, box.high.y}) {
      const double s = dot(Point{x, y} - origin, along);
      found.low = std::min(found.low, s);
      found.high = std::max(found.high, s);
    }
  return found;
}

}  // namespace

Layout orthocyclic(const Region& usable_area, double radius, Point tension_point, double angle, Progress progress) {
  Layout layout;
  Sites sites(usable_area, radius, progress);
  const std::optional<Point> first = sites.nearest(tension_point);
  if (!first) return layout;
  const double pitch = 2 * radius;
  const Point along{std::cos(angle), std::sin(angle)}, across = left_of(along);
  const Extent row = extent(usable_area.box(), *first, along), rows = extent(usable_area.box(), *first, across);
  const double rise = pitch * std::sqrt(0.75);
  const int most = static_cast<int>(std::max(rows.high, -rows.low) / rise) + 1;
  const double longest = std::max(row.high, -row.low);
  for (int step = 0; step <= most; ++step) {
    progress.report("laying", static_cast<double>(step) / (most + 1));
    for (const int j : {step, -step}) {
      if (j == 0 && !layout.wires.empty()) continue;
      // Odd rows begin half a pitch beside the first wire.
      const double start = j % 2 == 0 ? 0 : radius;
      for (int k = 0; k <= static_cast<int>(longest / pitch) + 1; ++k) {
        const auto lay = [&](int i) {
          const Point place = *first + (start + pitch * i) * along + (rise * j) * across;
          if (sites.in_room(place)) layout.wires.push_back(place);
        };
        lay(k);
        if (start > 0)
          lay(-1 - k);
        else if (k > 0)
          lay(-k);
      }
    }
  }
  return layout;
}

}  // namespace bahnwerk::winding
