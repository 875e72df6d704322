#pragma once
/// Wires that are all drawn to one point.
#include <vector>

#include "core/winding/layout/sites.hpp"

namespace bahnwerk::test {

inline std::vector<Point> drawn_to(const Region& usable_area, double radius, Point point) {
  winding::Sites sites(usable_area, radius);
  while (const auto place = sites.nearest(point)) sites.lay(*place);
  return {sites.wires().begin(), sites.wires().end()};
}

}  // namespace bahnwerk::test
