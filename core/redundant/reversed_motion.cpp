#include "core/redundant/reversed_motion.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk {
namespace {

std::vector<ReversedMotion::Part> whole(const Motion& motion) {
  std::vector<ReversedMotion::Part> parts;
  parts.reserve(motion.pieces());
  for (std::size_t i = motion.pieces(); i-- > 0;)
    parts.push_back({i, motion.end(i), motion.duration() - motion.end(i)});
  return parts;
}

}  // namespace

ReversedMotion::ReversedMotion(std::shared_ptr<const Motion> motion, std::vector<Part> parts, double duration)
    : motion_(std::move(motion)), parts_(std::move(parts)), duration_(duration) {}

ReversedMotion::ReversedMotion(const std::shared_ptr<const Motion>& motion)
    : ReversedMotion(motion, whole(*motion), motion->duration()) {}

MotionState ReversedMotion::in_piece(std::size_t piece, double t) const {
  const Part& part = parts_[piece];
  const double at = std::clamp(part.end - (t - part.begin), motion_->begin(part.piece), motion_->end(part.piece));
  MotionState state = motion_->in_piece(part.piece, at);
  for (const std::size_t odd : {1, 3})
    for (double& x : state[odd]) x = -x;
  return state;
}

bool ReversedMotion::polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const {
  const Part& part = parts_[piece];
  Polynomial p;
  if (!motion_->polynomial(part.piece, axis, p)) return false;
  out = shifted(std::move(p), part.end - motion_->begin(part.piece), -1);
  return true;
}

}  // namespace bahnwerk
