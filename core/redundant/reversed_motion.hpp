#pragma once
/// A motion run backwards in time, composed of the pieces of another motion.
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Runs parts of the pieces of a motion backwards, beginning with the last piece.
class ReversedMotion final : public Motion {
 public:
  struct Part {
    std::size_t piece = 0;  ///< piece of the original motion
    double end = 0;         ///< s, time in the original motion at which the part ends
    double begin = 0;       ///< s, time in the reversed motion at which the part begins
  };
  /// `parts` covers the whole motion: the first part begins at 0, and each begins where the one before ends. `duration`
  /// is the end of the last part. Durations agree with the original motion's up to rounding.
  ReversedMotion(std::shared_ptr<const Motion> motion, std::vector<Part> parts, double duration);
  /// Reverses the motion with one part per piece.
  explicit ReversedMotion(const std::shared_ptr<const Motion>& motion);
  std::size_t axes() const override { return motion_->axes(); }
  std::size_t pieces() const override { return parts_.size(); }
  double begin(std::size_t piece) const override { return parts_[piece].begin; }
  double duration() const override { return duration_; }
  MotionState in_piece(std::size_t piece, double t) const override;
  int highest_order() const override { return motion_->highest_order(); }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  std::shared_ptr<const Motion> motion_;
  std::vector<Part> parts_;
  double duration_;
};

}  // namespace bahnwerk
