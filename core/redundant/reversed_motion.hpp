#pragma once
/// A motion run backwards in time.
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Parts of the pieces of a motion, from the last one on, each from its end to its begin.
class ReversedMotion final : public Motion {
 public:
  struct Part {
    std::size_t piece = 0;  ///< of the motion
    double end = 0;         ///< s, when the part ends in it
    double begin = 0;       ///< s, when it begins backwards
  };
  /// `parts`: all there are, the first one begins at 0 and each where the one before ends, as long as in the motion but
  /// for rounding. `duration`: where the last one ends.
  ReversedMotion(std::shared_ptr<const Motion> motion, std::vector<Part> parts, double duration);
  /// Its pieces whole.
  explicit ReversedMotion(const std::shared_ptr<const Motion>& motion);
  std::size_t axes() const override { return motion_->axes(); }
  std::size_t pieces() const override { return parts_.size(); }
  double begin(std::size_t piece) const override { return parts_[piece].begin; }
  double duration() const override { return duration_; }
  MotionState in_piece(std::size_t piece, double t) const override;
  bool has_snap() const override { return motion_->has_snap(); }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  std::shared_ptr<const Motion> motion_;
  std::vector<Part> parts_;
  double duration_;
};

}  // namespace bahnwerk
