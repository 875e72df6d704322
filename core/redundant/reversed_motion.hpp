#pragma once
/// A motion run backwards in time.
#include <memory>
#include <utility>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// At t it is where `motion` is at its duration less t. Its pieces are those of `motion`, from the last one on.
class ReversedMotion final : public Motion {
 public:
  explicit ReversedMotion(std::shared_ptr<const Motion> motion) : motion_(std::move(motion)) {}
  std::size_t axes() const override { return motion_->axes(); }
  std::size_t pieces() const override { return motion_->pieces(); }
  double begin(std::size_t piece) const override {
    return piece == 0 ? 0 : motion_->duration() - motion_->end(original(piece));
  }
  double duration() const override { return motion_->duration(); }
  MotionState in_piece(std::size_t piece, double t) const override;
  bool has_snap() const override { return motion_->has_snap(); }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  std::size_t original(std::size_t piece) const { return motion_->pieces() - 1 - piece; }

  std::shared_ptr<const Motion> motion_;
};

}  // namespace bahnwerk
