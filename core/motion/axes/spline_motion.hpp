#pragma once
/// Axes that follow polynomials in time, piece by piece, as the cam and probe planners make them.
#include <vector>

#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

inline constexpr std::size_t max_motion_degree = 21;

/// Immutable and thread-safe.
class SplineMotion final : public Motion {
 public:
  /// A piece lasts from the end of the previous piece (0 for the first) to `end` s.
  struct Piece {
    double end = 0;
    std::vector<Polynomial> axes;  ///< positions over the time since the beginning of the piece, unit; one per axis
  };
  /// Throws std::invalid_argument for no pieces, times that do not increase, axes that differ in number or are none or
  /// more than max_axes, and degrees above max_motion_degree. The verifier checks whether the pieces fit together.
  explicit SplineMotion(std::vector<Piece> pieces);
  std::size_t axes() const override { return pieces_.front().axes.size(); }
  std::size_t pieces() const override { return pieces_.size(); }
  double begin(std::size_t piece) const override { return piece == 0 ? 0 : pieces_[piece - 1].end; }
  double duration() const override { return pieces_.back().end; }
  /// O(axes · degree).
  MotionState in_piece(std::size_t piece, double t) const override;
  int highest_order() const override { return 4; }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  std::vector<Piece> pieces_;
};

/// Returns the pieces with every time multiplied by `factor` > 0.
std::vector<SplineMotion::Piece> slowed(std::vector<SplineMotion::Piece> pieces, double factor);

}  // namespace bahnwerk
