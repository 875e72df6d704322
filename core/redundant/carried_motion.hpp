#pragma once
/// Coarse axes some of which do exactly what the head does, so that their fine axes stand still or need not exist.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/motion.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/path_motion.hpp"

namespace bahnwerk {

/// Axis k is that of the head where `carried[k]`, else that of `split`. Its pieces end where a piece of either does. On
/// straight segments a carried axis is a polynomial, on curves it is not.
class CarriedMotion final : public Motion {
 public:
  /// `split` has as many axes as the head and lasts as long; none where every axis is carried. Throws
  /// std::invalid_argument where axes differ in number.
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
    std::size_t head, split;  // the piece of either
  };
  MotionState chosen(MotionState carried, const MotionState& split) const;

  std::shared_ptr<const PathMotion> head_;
  std::shared_ptr<const SplineMotion> split_;
  std::vector<bool> carried_;
  std::vector<Begin> begin_;
};

}  // namespace bahnwerk
