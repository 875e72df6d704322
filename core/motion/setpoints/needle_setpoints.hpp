#pragma once
/// The setpoints of a winding machine: its axes, the needle's pose and speed, the brake of the wire.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/motion_setpoints.hpp"

namespace bahnwerk {

/// Columns of MotionSetpoints, then j<axis> of every axis, x, y, z (mm), phi, psi (deg) of the needle in the part's
/// frame, s (mm) and v (mm/s) along its path, brake (N). Rotary axes in deg and deg/s…: what an axis of unit rad counts
/// is in shown().
class NeedleSetpoints final : public MotionSetpoints {
 public:
  /// `motion` drives `axes` and lasts `cycles` whole cycles; `brake`: the tension that the wire's brake is set to, N.
  NeedleSetpoints(const std::shared_ptr<const PathMotion>& motion, std::shared_ptr<const KinematicAxisPath> axes,
                  const Machine& machine, std::size_t cycles, double brake);
  /// Per axis of the machine: 180/π for one of unit rad, else 1.
  static std::vector<double> shown(const Machine& machine);

 private:
  void write(Row& row, double* out) const override;

  std::shared_ptr<const PathMotion> motion_;
  std::shared_ptr<const KinematicAxisPath> axes_;
  std::vector<double> shown_;
  double brake_;
};

}  // namespace bahnwerk
