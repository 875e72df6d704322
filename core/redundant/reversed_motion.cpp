#include "core/redundant/reversed_motion.hpp"

#include <algorithm>

namespace bahnwerk {

MotionState ReversedMotion::in_piece(std::size_t piece, double t) const {
  const std::size_t from = original(piece);
  const double at = std::clamp(motion_->duration() - t, motion_->begin(from), motion_->end(from));
  MotionState state = motion_->in_piece(from, at);
  for (double& v : state.velocity) v = -v;
  for (double& j : state.jerk) j = -j;
  return state;
}

bool ReversedMotion::polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const {
  const std::size_t from = original(piece);
  Polynomial p;
  if (!motion_->polynomial(from, axis, p)) return false;
  out = shifted(std::move(p), motion_->end(from) - motion_->begin(from), -1);
  return true;
}

}  // namespace bahnwerk
