#include "core/motion/setpoints/path_setpoints.hpp"

#include <utility>

namespace bahnwerk {

PathSetpoints::PathSetpoints(std::shared_ptr<const PathMotion> motion, const Machine& machine, std::size_t cycles)
    : MotionSetpoints(motion, machine, cycles), motion_(std::move(motion)) {
  add_column({"s", "mm"});
  add_column({"v", "mm/s"});
}

MotionState PathSetpoints::state(Row& row) const {
  row.piece = motion_->law().find(row.t, row.piece);
  const LawState x = motion_->along(row.piece, row.t);
  row.s = x.s, row.v = x.v;
  return motion_->driven(row.piece, x);
}

void PathSetpoints::further_columns(Row& row, double* out) const {
  out[0] = row.last ? motion_->path().length() : row.s;
  out[1] = row.last ? 0 : row.v;
}

}  // namespace bahnwerk
