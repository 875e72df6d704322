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
  std::vector<Polyline3> outline;     ///< lines of the part, drawn below the path
  std::size_t last_turn = 0;          ///< the piece that begins the last turn, which is drawn bold
  std::size_t turns = 1;              ///< number of turns; the earlier ones are the fainter the more there are
  std::vector<Polyline3> coils = {};  ///< slots or poles that have a coil
  std::vector<Polyline3> posts = {};  ///< posts of the winding tools
  std::vector<Polyline3> wires = {};  ///< wires where they are laid
  std::vector<SlotLabel> slots = {};  ///< numbers of the slots
  double needle_length = 0;           ///< mm, of the needle, which is drawn at the end of the path; 0: it is not
  double needle_width = 0;            ///< mm
};
/// Draws the path isometrically, seen from above between the x and the y axis, z upwards: the last turn bold and red,
/// earlier ones faint and blue, marks at both ends, a key and a scale along the axes; below the path the part with its
/// slots' numbers, those of the coils dark, posts, laid wires, and the needle where the path ends. Numbers that would
/// overlap are left out. Lines are thinned to what is visible.
std::string path_drawing(const DrawnPath& drawn);

/// Draws the curvature, 1/mm, over the arc length, mm, of consecutive pieces; joints are vertical lines where there are
/// few.
std::string curvature_chart(std::span<const BezierPiece> pieces, const std::string& title);

}  // namespace bahnwerk::winding
