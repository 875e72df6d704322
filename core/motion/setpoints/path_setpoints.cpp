#include "core/motion/setpoints/path_setpoints.hpp"

#include <utility>

namespace bahnwerk {

PathSetpoints::PathSetpoints(std::shared_ptr<const PathMotion> motion, const Machine& machine, std::size_t cycles)
    : MotionSetpoints(motion, machine, cycles), motion_(std::move(motion)) {
  add_column({"s", "mm"});
  add_column({"v", "mm/s"});
}

void PathSetpoints::write(Row& row, double* out) const {
  double* const along = out + 3 * motion_->axes();
  if (row.last) {
    write_end(out);
    along[0] = motion_->path().length(), along[1] = 0;
    return;
  }
  row.piece = motion_->law().find(row.t, row.piece);
  const LawState x = motion_->along(row.piece, row.t);
  motion_->write_driven(row.piece, x, out);
  along[0] = x.s, along[1] = x.v;
}

}  // namespace bahnwerk
