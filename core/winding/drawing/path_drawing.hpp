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
  std::size_t last_turn = 0;       ///< the piece that begins the last turn: from there on the path is drawn bold
  std::size_t turns = 1;           ///< the more there are, the fainter those before the last
};
/// Isometric, seen from above between the x and the y axis, z upwards; the last turn bold and red, those before faint
/// and blue, marks at begin and end, a key and a scale along the axes. Lines are thinned to what shows.
std::string path_drawing(const DrawnPath& drawn);

/// Curvature, 1/mm, over the arc length, mm, of pieces end to end; joints as vertical lines where there are few.
std::string curvature_chart(std::span<const BezierPiece> pieces, const std::string& title);

}  // namespace bahnwerk::winding
