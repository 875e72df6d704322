#include "core/winding/laying/needle.hpp"

#include <algorithm>
#include <optional>

#include "core/base/progress.hpp"
#include "core/winding/layout/sites.hpp"

namespace bahnwerk::winding {
namespace {

/// Returns the estimated share of the wires laid, from the area that they need at least.
double share(std::size_t wires, const Region& usable_area, double radius) {
  return std::min(1.0, static_cast<double>(wires) * 3.5 * radius * radius / usable_area.area());
}

}  // namespace

NeedleLayout needle(const LayingRegions& regions, double radius, Point tie_in, Progress progress) {
  NeedleLayout layouts;
  std::array<Sites, 4> sites{
      Sites(regions.at[0].usable_area, radius, progress), Sites(regions.at[1].usable_area, radius, progress),
      Sites(regions.at[2].usable_area, radius, progress), Sites(regions.at[3].usable_area, radius, progress)};
  Point tension_point = tie_in;
  for (;;) {
    progress.report("laying", share(layouts[0].wires.size(), regions.at[0].usable_area, radius));
    for (std::size_t j = 0; j < 4; ++j) {
      const std::optional<Point> place = sites[j].nearest(tension_point);
      if (!place) {
        for (std::size_t k = 0; k < j; ++k) {
          layouts[k].wires.pop_back();
          layouts[k].tension_points.pop_back();
        }
        return layouts;
      }
      sites[j].lay(*place);
      layouts[j].wires.push_back(*place);
      layouts[j].tension_points.push_back(tension_point);
      tension_point = regions.at[(j + 1) % 4].begin.foot(regions.held(j, *place));
    }
  }
}

std::vector<Point> turn_pulls(const LayingRegions& regions, const Layout& layout) {
  std::vector<Point> tension_points;
  for (const Point wire : layout.wires) tension_points.push_back(regions.at[2].begin.foot(regions.held(1, wire)));
  return tension_points;
}

NeedleLayout needle(const Slot& slot, double radius, const StatorHeads& heads, Progress progress) {
  return needle(laying_regions(slot, heads), radius, slot.tension_point, progress);
}
NeedleLayout needle(const Slot& slot, double radius, const RotorHeads& heads, Progress progress) {
  return needle(laying_regions(slot, heads), radius, slot.tension_point, progress);
}

}  // namespace bahnwerk::winding
