#pragma once
/// The setpoints of axes that follow a path: the axes, and place and speed of the tool along its path.
#include <cstddef>
#include <memory>

#include "core/machine/machine.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/motion_setpoints.hpp"

namespace bahnwerk {

/// Columns of MotionSetpoints, then s (mm) and v (mm/s).
class PathSetpoints : public MotionSetpoints {
 public:
  /// `motion` already lasts a whole number of cycles.
  PathSetpoints(std::shared_ptr<const PathMotion> motion, const Machine& machine, std::size_t cycles);

 protected:
  /// Returns the number of columns before those that derived classes add.
  std::size_t path_columns() const { return 3 * motion_->axes() + 2; }
  /// Evaluates the law once for the axes, s and v.
  void write(Row& row, double* out) const override;

 private:
  std::shared_ptr<const PathMotion> motion_;
};

}  // namespace bahnwerk
