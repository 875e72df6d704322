#include "core/plan/coarse_fine/coarse_fine_setpoints.hpp"

#include <string>
#include <utility>

namespace bahnwerk {

CoarseFineSetpoints::CoarseFineSetpoints(const std::shared_ptr<const PathMotion>& head,
                                         std::shared_ptr<const Motion> coarse, const Contour& contour,
                                         const Machine& machine, std::size_t cycles)
    : ContourSetpoints(head, contour, machine, cycles), coarse_(std::move(coarse)) {
  for (const auto& [prefix, per] : {std::pair{"", ""}, std::pair{"v", "/s"}, std::pair{"a", "/s²"}})
    for (const char* stage : {"c", "f"})
      for (const AxisLimits& axis : machine.axes) add_column({prefix + axis.name + stage, axis.unit + per});
}

void CoarseFineSetpoints::write(Row& row, double* out) const {
  ContourSetpoints::write(row, out);
  const MotionState coarse = row.last ? coarse_->final_state() : coarse_->evaluate(row.t);
  const std::size_t axes = coarse_->axes();
  const double* head = out;
  out += contour_columns();
  for (std::size_t order = 0; order < 3; ++order) {
    for (std::size_t k = 0; k < axes; ++k) out[k] = coarse[order][k], out[axes + k] = head[k] - coarse[order][k];
    head += axes, out += 2 * axes;
  }
}

}  // namespace bahnwerk
