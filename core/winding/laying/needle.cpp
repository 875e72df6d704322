#include "core/winding/laying/needle.hpp"

#include <algorithm>
#include <optional>

#include "core/winding/layout/sites.hpp"

namespace bahnwerk::winding {
namespace {

/// Where the wire at `place` is still held before it leaves a region: `hold` before the region's end along the wire.
Space held(const LayingRegion& region, Point place, double hold) {
  const Space begin = region.begin.place(place), end = region.end.place(place);
  const Space d{begin.x - end.x, begin.y - end.y, begin.z - end.z};
  const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  const double k = length > 0 ? hold / length : 0;
  return {end.x + k * d.x, end.y + k * d.y, end.z + k * d.z};
}

/// Share of the wires laid, from the area that they take at least.
double share(std::size_t wires, const Region& room, double radius) {
  return std::min(1.0, static_cast<double>(wires) * 3.5 * radius * radius / room.area());
}

}  // namespace

NeedleLayout needle(const LayingRegions& regions, double radius, Point tie_in, Progress& progress) {
  NeedleLayout layouts;
  std::array<Sites, 4> sites{Sites(regions.at[0].room, radius, &progress), Sites(regions.at[1].room, radius, &progress),
                             Sites(regions.at[2].room, radius, &progress),
                             Sites(regions.at[3].room, radius, &progress)};
  Point pull = tie_in;
  for (;;) {
    progress.report("laying", share(layouts[0].wires.size(), regions.at[0].room, radius));
    for (std::size_t j = 0; j < 4; ++j) {
      const std::optional<Point> place = sites[j].nearest(pull);
      if (!place) {
        for (std::size_t k = 0; k < j; ++k) {
          layouts[k].wires.pop_back();
          layouts[k].pulls.pop_back();
        }
        return layouts;
      }
      sites[j].lay(*place);
      layouts[j].wires.push_back(*place);
      layouts[j].pulls.push_back(pull);
      pull = regions.at[(j + 1) % 4].begin.foot(held(regions.at[j], *place, regions.hold));
    }
  }
}

std::vector<Point> turn_pulls(const LayingRegions& regions, const Layout& layout) {
  std::vector<Point> pulls;
  for (const Point wire : layout.wires)
    pulls.push_back(regions.at[2].begin.foot(held(regions.at[1], wire, regions.hold)));
  return pulls;
}

Layout needle(const Region& room, double radius, Point pull, Progress& progress) {
  Layout layout;
  Sites sites(room, radius, &progress);
  while (const std::optional<Point> place = sites.nearest(pull)) {
    progress.report("laying", share(layout.wires.size(), room, radius));
    sites.lay(*place);
    layout.wires.push_back(*place);
    layout.pulls.push_back(pull);
  }
  return layout;
}

NeedleLayout needle(const Slot& slot, double radius, const StatorHeads& heads, Progress& progress) {
  return needle(laying_regions(slot, heads), radius, slot.pull, progress);
}
NeedleLayout needle(const Slot& slot, double radius, const RotorHeads& heads, Progress& progress) {
  return needle(laying_regions(slot, heads), radius, slot.pull, progress);
}

}  // namespace bahnwerk::winding
