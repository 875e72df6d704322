#pragma once
/// The setpoints of axes that follow a path: the axes, and the tool's place and speed along its path.
#include <cstddef>
#include <memory>

#include "core/machine/machine.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/motion_setpoints.hpp"

namespace bahnwerk {

/// Columns of MotionSetpoints, then s (mm) and v (mm/s).
class PathSetpoints : public MotionSetpoints {
 public:
  /// `motion` must already last a whole number of cycles.
  PathSetpoints(std::shared_ptr<const PathMotion> motion, const Machine& machine, std::size_t cycles);

 protected:
  /// How many columns stand before those that are added to these.
  std::size_t path_columns() const { return 3 * motion_->axes() + 2; }
  /// Evaluates the law once for the axes, s and v.
  void write(Row& row, double* out) const override;

 private:
  std::shared_ptr<const PathMotion> motion_;
};

}  // namespace bahnwerk
