#pragma once
/// A region's boundary as the data of an SVG path.
#include <string>
#include <vector>

#include "core/drawing/svg.hpp"
#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

/// Returns the path data. `frame(point)` is in pixels, y downwards; `scale` in px per mm.
template <class Frame>
std::string region_path(const Region& region, const Frame& frame, double scale) {
  std::string d;
  for (std::size_t i = 0; i < region.edges().size(); ++i) {
    const Edge& edge = region.edges()[i];
    const auto to = [&](const std::string& command, Point p) {
      const Point q = frame(p);
      return command + svg::number(q.x) + " " + svg::number(q.y);
    };
    if (region.begins_loop(i)) d += to("M", edge.from);
    // An arc of an SVG path must not be a whole circle: it is drawn in two halves.
    for (const double f : edge.straight() ? std::vector{1.0} : std::vector{0.5, 1.0})
      d += edge.straight() ? to("L", edge.to)
                           : to("A" + svg::number(scale * edge.radius) + " " + svg::number(scale * edge.radius) +
                                    " 0 0 " + (edge.turn > 0 ? "0 " : "1 "),
                                edge.at(f));
    const bool last = i + 1 == region.edges().size() || region.begins_loop(i + 1);
    if (last) d += "Z";
  }
  return d;
}

}  // namespace bahnwerk::winding
