#pragma once
/// A coarse motion adapted to the head's motion as its setpoints have it: slowed alike, with common borders of pieces
/// and exact rest at the end.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// `motion` slowed by `factor` ≥ 1, like the head's law, followed by axes that stand still at `still`. Where its pieces
/// and the law's pieces end at the same time up to rounding, they end at the law's time; otherwise there would be
/// instants at which the head has changed its acceleration and the coarse axes have not. The rounding error that
/// thousands of pieces sum up to at the end, instead of rest, is removed within the last piece of each axis that is
/// polynomial there. The fitted motion is what is verified and sampled. final_state() is at rest.
class FittedMotion final : public Motion {
 public:
  /// `rest` is the order up to which derivatives are 0 at the end: 1 velocity, 2 also acceleration. O(pieces of both).
  /// Throws std::invalid_argument for more than max_axes axes.
  FittedMotion(std::shared_ptr<const Motion> motion, double factor, const TimeLaw& law, std::vector<double> still,
               int rest = 1);
  std::size_t axes() const override { return motion_->axes() + still_.size(); }
  std::size_t pieces() const override { return begin_.size(); }
  double begin(std::size_t piece) const override { return begin_[piece]; }
  double duration() const override { return duration_; }
  MotionState in_piece(std::size_t piece, double t) const override;
  MotionState final_state() const override;
  int highest_order() const override { return motion_->highest_order(); }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  void end_at_rest(int rest);

  std::shared_ptr<const Motion> motion_;
  double factor_, duration_;
  std::vector<double> still_, begin_;
  std::vector<Polynomial> last_;  // per axis: the corrected last piece; empty if it is not polynomial
};

}  // namespace bahnwerk
