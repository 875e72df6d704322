#pragma once
/// The setpoints of a probe path.
#include <memory>
#include <vector>

#include "core/motion/setpoints/motion_setpoints.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

/// Setpoints with the columns of MotionSetpoints, then j<axis> of every axis (mm/s³), `deviation` (mm), the distance
/// from the edge that is being passed, and `v` (mm/s), the speed.
class ProbeSetpoints final : public MotionSetpoints {
 public:
  /// `motion` lasts `cycles` whole cycles.
  ProbeSetpoints(std::shared_ptr<const ProbeProblem> problem, ProbeMotion motion, std::size_t cycles);

 private:
  void write(Row& row, double* out) const override;

  std::shared_ptr<const ProbeProblem> problem_;
  ProbeMotion motion_;
};

}  // namespace bahnwerk
