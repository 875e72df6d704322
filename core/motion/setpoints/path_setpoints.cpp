#include "core/motion/setpoints/path_setpoints.hpp"

#include <utility>

namespace bahnwerk {

PathSetpoints::PathSetpoints(std::shared_ptr<const PathMotion> motion, const Machine& machine, std::size_t cycles)
    : MotionSetpoints(motion, machine, cycles), motion_(std::move(motion)) {
  add_column({"s", "mm"});
  add_column({"v", "mm/s"});
}

void PathSetpoints::further_columns(Row& row, double* out) const {
  const LawState along = row.last ? LawState{motion_->path().length(), 0, 0, 0} : motion_->along(row.piece, row.t);
  out[0] = along.s;
  out[1] = along.v;
}

}  // namespace bahnwerk
