#pragma once
/// Rational pieces in five coordinates as what machines follow: a path of the tool and its orientation.
#include <memory>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/motion/axes/orientation.hpp"

namespace bahnwerk {

struct PosePath {
  Path tool;  ///< source() of a segment: index of its piece
  std::shared_ptr<const Orientation> orientation;
};

/// Pieces begin where the ones before end. Throws what Rational::bezier, Path::append and Orientation throw. O(pieces).
PosePath pose_path(const std::vector<BezierPiece>& pieces);

}  // namespace bahnwerk
