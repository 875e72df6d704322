#pragma once
/// Axes that follow polynomials in time, piece by piece: what cam and probe planners make.
#include <vector>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

inline constexpr std::size_t max_motion_degree = 21;

class SplineMotion final : public Motion {
 public:
  /// From 0 to `end` s, which is also where further pieces go on.
  struct Piece {
    double end = 0;
    std::vector<Polynomial> axes;  ///< positions over the time since the piece began, unit; one per axis
  };
  /// Throws std::invalid_argument for no pieces, times that do not rise, axes that differ in number or are none or more
  /// than max_axes, and degrees above max_motion_degree. Whether pieces fit together is for the verifier to say.
  explicit SplineMotion(std::vector<Piece> pieces);
  std::size_t axes() const override { return pieces_.front().axes.size(); }
  std::size_t pieces() const override { return pieces_.size(); }
  double begin(std::size_t piece) const override { return piece == 0 ? 0 : pieces_[piece - 1].end; }
  double duration() const override { return pieces_.back().end; }
  /// O(axes · degree).
  MotionState in_piece(std::size_t piece, double t) const override;
  bool has_snap() const override { return true; }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  std::vector<Piece> pieces_;
};

/// The same places, `factor` > 0 times as late.
std::vector<SplineMotion::Piece> slowed(std::vector<SplineMotion::Piece> pieces, double factor);

}  // namespace bahnwerk
