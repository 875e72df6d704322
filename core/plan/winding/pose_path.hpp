#pragma once
/// Converts rational pieces in five coordinates (position and two angles) to the form that machines follow: a path of
/// the tool and its orientation.
#include <memory>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/motion/axes/orientation.hpp"

namespace bahnwerk {

struct PosePath {
  Path tool;  ///< source() of a segment is the index of its piece
  std::shared_ptr<const Orientation> orientation;
};

/// Returns path and orientation of consecutive pieces. Throws what Rational::bezier, Path::append and Orientation
/// throw. O(pieces).
PosePath pose_path(const std::vector<BezierPiece>& pieces);

}  // namespace bahnwerk
