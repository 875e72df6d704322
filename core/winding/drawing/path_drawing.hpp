#pragma once
/// The needle's path in space and its curvature as SVG.
#include <span>
#include <string>
#include <vector>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/winding/drawing/part_outline.hpp"

namespace bahnwerk::winding {

struct DrawnPath {
  std::string title;
  std::span<const BezierPiece> pieces;
  std::vector<SpaceLine> outline;  ///< of the part, drawn below the path
};
/// Isometric, seen from above between the x and the y axis, z upwards; coloured from the path's begin (blue) to its end
/// (red), with a scale along the axes. Lines are thinned to what shows.
std::string path_drawing(const DrawnPath& drawn);

/// Curvature, 1/mm, over the arc length, mm, of pieces end to end; joints as vertical lines where there are few.
std::string curvature_chart(std::span<const BezierPiece> pieces, const std::string& title);

}  // namespace bahnwerk::winding
