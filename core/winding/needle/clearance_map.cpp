#include "core/winding/needle/clearance_map.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/progress.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {

NeedlePose tip_pose(const StatorPart& part, Point tip, std::optional<double> pivot_limit) {
  const Vec3 place{part.heads.base_radius - tip.y, tip.x, part.heads.stack / 2};
  const double opening = part.heads.base_radius - part.slot.height - part.slot.tip_corner_radius;
  // Without bend and free length the tip is at the wire's place.
  return slot_support(place, {0, 0, -1}, 0, 0, {opening, 0, 0}, pivot_limit)->pose;
}

double tip_clearance(const StatorPart& part, const StatorIron& iron, const NeedleShape& needle, Point tip,
                     std::optional<double> pivot_limit, double tolerance) {
  const NeedlePose pose = tip_pose(part, tip, pivot_limit);
  Progress silent;
  return clearance(std::vector<NeedleMove>{{pose, pose}}, needle, {&iron}, tolerance, silent).minimum;
}

double ClearanceMap::share(double clearance) const {
  std::size_t inside = 0, enough = 0;
  for (const double value : values) {
    inside += !std::isnan(value);
    enough += value >= clearance;
  }
  return inside > 0 ? static_cast<double>(enough) / static_cast<double>(inside) : 0;
}

ClearanceMap clearance_map(const StatorPart& part, const Slot& slot, const NeedleShape& needle,
                           std::optional<double> pivot_limit, double step, Progress progress) {
  const Point size = slot.iron.box().high - slot.iron.box().low;
  if (!(step > 0) || !(size.x / step * (size.y / step) < 1e6))
    throw std::invalid_argument("a map needs cells of positive size, at most a million");
  const StatorIron iron(part, slot);
  ClearanceMap map;
  map.step = step;
  map.columns = static_cast<std::size_t>(std::ceil(size.x / step));
  map.rows = static_cast<std::size_t>(std::ceil(size.y / step));
  // The map is symmetric about the slot's middle.
  const double wide = step * static_cast<double>(map.columns);
  map.low = {(slot.iron.box().low.x + slot.iron.box().high.x - wide) / 2, slot.iron.box().low.y};
  map.values.reserve(map.columns * map.rows);
  for (std::size_t row = 0; row < map.rows; ++row)
    for (std::size_t column = 0; column < map.columns; ++column) {
      if (map.values.size() % 256 == 0)
        progress.report("clearance map", static_cast<double>(row) / static_cast<double>(map.rows));
      const Point tip = map.middle(column, row);
      map.values.push_back(slot.iron.distance(tip) >= 0 ? tip_clearance(part, iron, needle, tip, pivot_limit)
                                                        : std::numeric_limits<double>::quiet_NaN());
    }
  return map;
}

}  // namespace bahnwerk::winding
