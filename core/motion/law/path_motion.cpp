#include "core/motion/law/path_motion.hpp"

#include <algorithm>

namespace bahnwerk {

LawState PathMotion::along(std::size_t piece, double t) const {
  const LawPiece& p = law_.pieces()[piece];
  LawState x = p.at(std::clamp(t - p.t0, 0.0, p.duration));
  x.s = std::clamp(x.s, p.s, p.s_end);
  return x;
}

MotionState PathMotion::in_piece(std::size_t piece, double t) const { return driven(piece, along(piece, t)); }

MotionState PathMotion::driven(std::size_t piece, const LawState& x) const {
  const AxisJet q = path_->at(law_.pieces()[piece].segment, x.s);
  const double v2 = x.v * x.v, v3 = v2 * x.v;
  MotionState state;
  for (std::size_t k = 0, n = axes(); k < n; ++k) {  // number by number: copying the array would wait for its stores
    state.position[k] = q.value[k];
    state.velocity[k] = q.d1[k] * x.v;
    state.acceleration[k] = q.d2[k] * v2 + q.d1[k] * x.a;
    state.jerk[k] = q.d3[k] * v3 + 3 * x.v * x.a * q.d2[k] + q.d1[k] * x.j;
  }
  return state;
}

MotionState PathMotion::final_state() const {
  MotionState state;
  if (const std::size_t segments = path_->size(); segments > 0)
    state.position = path_->at_parameter(segments - 1, (*path_)[segments - 1].curve().end()).value;
  return state;
}

}  // namespace bahnwerk
