#include "core/redundant/coarse/carried_motion.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double same =
    64 * std::numeric_limits<double>::epsilon();  // largest relative difference of times that counts as rounding

}  // namespace

CarriedMotion::CarriedMotion(std::shared_ptr<const PathMotion> head, std::shared_ptr<const SplineMotion> split,
                             std::vector<bool> carried)
    : head_(std::move(head)), split_(std::move(split)), carried_(std::move(carried)) {
  if (carried_.size() != head_->axes() || (split_ && split_->axes() != head_->axes()))
    throw std::invalid_argument("coarse axes are as many as the head's");
  const std::size_t n = head_->pieces(), m = split_ ? split_->pieces() : 1;
  for (std::size_t i = 0, j = 0; i < n && j < m;) {
    const double t = std::max(head_->begin(i), split_ ? split_->begin(j) : 0.0);
    begin_.push_back({t, i, j});
    const double end = head_->end(i), other = split_ ? split_->end(j) : head_->duration();
    const double blur = same * end;
    if (end <= other + blur) ++i;
    if (other <= end + blur) ++j;
  }
}

MotionState CarriedMotion::chosen(MotionState carried, const MotionState& split) const {
  for (std::size_t k = 0; k < carried_.size(); ++k) {
    if (carried_[k]) continue;
    for (std::size_t order = 0; order < MotionState::orders; ++order) carried[order][k] = split[order][k];
  }
  return carried;
}

MotionState CarriedMotion::in_piece(std::size_t piece, double t) const {
  const Begin& begin = begin_[piece];
  MotionState state = head_->in_piece(begin.head, t);
  return split_ ? chosen(state, split_->in_piece(begin.split, t)) : state;
}

MotionState CarriedMotion::final_state() const {
  const MotionState state = head_->final_state();
  return split_ ? chosen(state, split_->final_state()) : state;
}

bool CarriedMotion::polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const {
  const Begin& begin = begin_[piece];
  if (!carried_[axis]) {
    Polynomial p;
    if (!split_->polynomial(begin.split, axis, p)) return false;
    out = shifted(p, begin.t - split_->begin(begin.split), 1);
    return true;
  }
  const LawPiece& law = head_->law().pieces()[begin.head];
  if (!head_->path().linear(law.segment)) return false;
  const LawState x = law.at(begin.t - law.t0);
  const AxisJet q = head_->path().at(law.segment, x.s);
  const double rate = q.d1[axis];
  out = {q.value[axis], rate * x.v, rate * x.a / 2, rate * x.j / 6, rate * law.snap / 24};
  return true;
}

}  // namespace bahnwerk
