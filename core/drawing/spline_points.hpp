#pragma once
/// Samples of a path of rational pieces for drawings and viewers, and its curvature over the arc length.
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"

namespace bahnwerk {

/// Returns points x, y, z, φ, ψ whose connecting lines stay within `tolerance` mm of the path and `angle_tolerance` rad
/// of its angles, by three points inside each interval. Ends of pieces are among them, once where one piece begins at
/// the end of the one before. O(points).
std::vector<SplinePoint> spline_points(std::span<const BezierPiece> pieces, double tolerance,
                                       double angle_tolerance = 0.01);

struct CurvaturePoint {
  double length = 0;     ///< mm, arc length from the path's begin
  double curvature = 0;  ///< 1/mm, curvature of the curve in space
  std::size_t piece = 0;
};
/// Returns `intervals` + 1 points for each piece, both ends included: where curvature jumps, two points have one
/// length. Lengths are computed by Gauss quadrature between the points. A piece without length has curvature 0.
std::vector<CurvaturePoint> curvature_points(std::span<const BezierPiece> pieces, std::size_t intervals = 64);

}  // namespace bahnwerk
