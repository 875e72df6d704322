#include "core/motion/law/path_motion.hpp"

#include <algorithm>

namespace bahnwerk {

MotionState PathMotion::in_piece(std::size_t piece, double t) const {
  const LawPiece& p = law_.pieces()[piece];
  const LawState x = p.at(std::clamp(t - p.t0, 0.0, p.duration));
  const AxisJet q = path_.at(p.segment, std::clamp(x.s, p.s, p.s_end));
  MotionState state;
  state.position = q.value;
  for (std::size_t k = 0; k < axes(); ++k) {
    state.velocity[k] = q.d1[k] * x.v;
    state.acceleration[k] = q.d2[k] * x.v * x.v + q.d1[k] * x.a;
    state.jerk[k] = q.d3[k] * x.v * x.v * x.v + 3 * q.d2[k] * x.v * x.a + q.d1[k] * x.j;
  }
  return state;
}

}  // namespace bahnwerk
