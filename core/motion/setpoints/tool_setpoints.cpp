#include "core/motion/setpoints/tool_setpoints.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/machine/degrees.hpp"

namespace bahnwerk {

ToolSetpoints::ToolSetpoints(const std::shared_ptr<const PathMotion>& motion, std::shared_ptr<const Contour> contour,
                             const Machine& machine, std::size_t cycles, ToolColumns columns)
    : ContourSetpoints(motion, *contour, in_degrees(machine), cycles),
      motion_(motion),
      contour_(std::move(contour)),
      shown_(std::move(columns)) {
  constexpr std::array names{"x", "y", "z"};
  for (std::size_t i = 0; i < shown_.coordinates; ++i) {
    const auto named = [&](const AxisLimits& axis) { return axis.name == names[i]; };
    if (std::any_of(machine.axes.begin(), machine.axes.end(), named)) continue;
    coordinates_.push_back(i);
    add_column({names[i], "mm"});
  }
}

void ToolSetpoints::write(Row& row, double* out) const {
  ContourSetpoints::write(row, out);
  const std::size_t axes = shown_.factors.size();
  for (std::size_t i = 0; i < 3 * axes; ++i) out[i] *= shown_.factors[i % axes];
  const double s = out[3 * axes];
  const Path& path = contour_->path;
  const std::size_t segment = row.last ? path.size() - 1 : motion_->law().pieces()[row.piece].segment;
  const Vec at = row.last ? path[segment].curve().at(path[segment].curve().end()).value : path[segment].at(s).value;
  out += contour_columns();
  for (const std::size_t i : coordinates_) *out++ = at[i] + (i == 2 ? shown_.height : 0);
}

}  // namespace bahnwerk
