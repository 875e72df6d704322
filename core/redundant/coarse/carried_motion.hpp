#pragma once
/// Motion of the coarse axes in which some axes carry out the head's motion themselves, so that their fine axes stand
/// still or do not exist.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/path_motion.hpp"

namespace bahnwerk {

/// Motion of N coarse axes. Axis k equals axis k of the head where `carried[k]` is true, else axis k of `split`. Piece
/// borders are those of both motions. A carried axis is polynomial in time on straight segments only.
class CarriedMotion final : public Motion {
 public:
  /// `split` has as many axes and the same duration as the head; it may be null if every axis is carried. Throws
  /// std::invalid_argument if the numbers of axes differ.
  CarriedMotion(std::shared_ptr<const PathMotion> head, std::shared_ptr<const SplineMotion> split,
                std::vector<bool> carried);
  const std::shared_ptr<const SplineMotion>& split() const { return split_; }
  const std::vector<bool>& carried() const { return carried_; }
  std::size_t axes() const override { return head_->axes(); }
  std::size_t pieces() const override { return begin_.size(); }
  double begin(std::size_t piece) const override { return begin_[piece].t; }
  double duration() const override { return head_->duration(); }
  MotionState in_piece(std::size_t piece, double t) const override;
  MotionState final_state() const override;
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  struct Begin {
    double t;
    std::size_t head, split;  // the pieces of both motions that hold t
  };
  MotionState chosen(MotionState carried, const MotionState& split) const;

  std::shared_ptr<const PathMotion> head_;
  std::shared_ptr<const SplineMotion> split_;
  std::vector<bool> carried_;
  std::vector<Begin> begin_;
};

}  // namespace bahnwerk
