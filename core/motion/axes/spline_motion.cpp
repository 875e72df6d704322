#include "core/motion/axes/spline_motion.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace bahnwerk {

SplineMotion::SplineMotion(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  double t = 0;
  for (const Piece& piece : pieces_) {
    if (!(piece.end > t)) throw std::invalid_argument("a piece of a spline ends after it begins");
    t = piece.end;
    if (piece.axes.empty() || piece.axes.size() > max_axes || piece.axes.size() != pieces_.front().axes.size())
      throw std::invalid_argument("all pieces of a spline have the same axes, one to eight");
    for (const Polynomial& axis : piece.axes)
      if (axis.size() > max_motion_degree + 1) throw std::invalid_argument("a spline has a degree of 21 at most");
  }
  if (pieces_.empty()) throw std::invalid_argument("a spline has one piece at least");
}

MotionState SplineMotion::in_piece(std::size_t piece, double t) const {
  const double x = t - begin(piece);
  MotionState state;
  for (std::size_t k = 0; k < axes(); ++k) {
    // Horner for the value and its first derivatives at once; d_n is what the n-th derivative is n! times of.
    double d[5] = {};
    const Polynomial& p = pieces_[piece].axes[k];
    for (std::size_t i = p.size(); i-- > 0;) {
      for (std::size_t n = 4; n > 0; --n) d[n] = d[n] * x + d[n - 1];
      d[0] = d[0] * x + p[i];
    }
    state[0][k] = d[0], state[1][k] = d[1], state[2][k] = 2 * d[2];
    state[3][k] = 6 * d[3], state[4][k] = 24 * d[4];
  }
  return state;
}

std::vector<SplineMotion::Piece> slowed(std::vector<SplineMotion::Piece> pieces, double factor) {
  for (SplineMotion::Piece& piece : pieces) {
    piece.end *= factor;
    for (Polynomial& axis : piece.axes) {
      double power = 1;
      for (double& coefficient : axis) coefficient /= power, power *= factor;
    }
  }
  return pieces;
}

bool SplineMotion::polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const {
  out = pieces_[piece].axes[axis];
  return true;
}

}  // namespace bahnwerk
