#pragma once
/// A spline that ends exactly at rest at the last point, without the rounding of its last piece.
#include <memory>
#include <utility>

#include "core/geometry/curve/vec.hpp"
#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {

class RestingMotion final : public Motion {
 public:
  RestingMotion(std::shared_ptr<const SplineMotion> motion, Vec end) : motion_(std::move(motion)), end_(end) {}
  std::size_t axes() const override { return motion_->axes(); }
  std::size_t pieces() const override { return motion_->pieces(); }
  double begin(std::size_t piece) const override { return motion_->begin(piece); }
  double duration() const override { return motion_->duration(); }
  MotionState in_piece(std::size_t piece, double t) const override { return motion_->in_piece(piece, t); }
  int highest_order() const override { return 4; }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override {
    return motion_->polynomial(piece, axis, out);
  }
  /// Returns the last point, with all derivatives 0.
  MotionState final_state() const override {
    MotionState state;
    for (std::size_t k = 0; k < axes(); ++k) state[0][k] = end_[k];
    return state;
  }

 private:
  std::shared_ptr<const SplineMotion> motion_;
  Vec end_;
};

}  // namespace bahnwerk
