#include "core/motion/profile/profile_change.hpp"

namespace bahnwerk {

SpeedChange SpeedChangeLaw::shape(double height) const {
  SpeedChange c;
  if (!(height > 0)) return c;
  double rise = 0;
  if (height >= full_) {
    rise = rise_;
    c.hold = std::max(0.0, height / A_ - rise_);
    c.acceleration = A_;
  } else {
    rise = duration(height) / 2;
    c.acceleration = height / rise;
  }
  if (rise >= 2 * jerk_ramp_) {
    c.ramp = jerk_ramp_;
    c.jerk_hold = rise - 2 * jerk_ramp_;
    c.jerk = J_;
  } else {
    c.ramp = rise / 2;
    c.jerk = S_ * c.ramp;
  }
  return c;
}

}  // namespace bahnwerk
