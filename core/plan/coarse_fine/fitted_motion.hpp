#pragma once
/// A coarse motion fitted to the head's motion that is served.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// `motion`, slowed to last `factor` ≥ 1 times as long, as the head's law already is; followed by axes that stand still
/// at `still`. Where its pieces and the law's end at the same time but for rounding, they end at the law's: else there
/// would be moments at which the head has switched its acceleration and the coarse axes have not. What thousands of
/// pieces added up to at the end instead of rest, by rounding, the last one takes out, in each axis that is a
/// polynomial there: it is the fitted motion that is verified and served. final_state() is at rest.
class FittedMotion final : public Motion {
 public:
  /// `rest`: the derivatives that are 0 at the end: 1 the velocity, 2 the acceleration, too. O(pieces of both). Throws
  /// std::invalid_argument for more than max_axes.
  FittedMotion(std::shared_ptr<const Motion> motion, double factor, const TimeLaw& law, std::vector<double> still,
               int rest = 1);
  std::size_t axes() const override { return motion_->axes() + still_.size(); }
  std::size_t pieces() const override { return begin_.size(); }
  double begin(std::size_t piece) const override { return begin_[piece]; }
  double duration() const override { return duration_; }
  MotionState in_piece(std::size_t piece, double t) const override;
  MotionState final_state() const override;
  bool has_snap() const override { return motion_->has_snap(); }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  void end_at_rest(int rest);

  std::shared_ptr<const Motion> motion_;
  double factor_, duration_;
  std::vector<double> still_, begin_;
  std::vector<Polynomial> last_;  // per axis: the last piece, corrected; empty where it is no polynomial
};

}  // namespace bahnwerk
