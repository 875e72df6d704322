#pragma once
/// A line or an arc of the plane, offset by a cutter's radius, and the crossing of two of them.
#include <optional>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::gcode {

/// Returns the vector to the left of a direction, mm; z is ignored.
inline Vec left_of(Vec direction) { return {-direction.y, direction.x, 0}; }
inline double turn_of(Vec from, Vec to) {  ///< angle between directions, rad, within ±π, counter-clockwise positive
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}
Vec turned(Vec direction, double angle);  ///< turns counter-clockwise by `angle`, rad

/// A piece in the plane (z = 0). `radius` 0 and `sweep` 0 mean a line; an arc that has shrunk to its centre has no
/// length.
struct OffsetPiece {
  Vec from, to;     ///< ends of the piece, offset and trimmed
  Vec corner_from;  ///< programmed ends of the move
  Vec corner_to;
  Vec direction_from;  ///< unit tangents at both ends
  Vec direction_to;
  bool arc = false;
  Vec centre;
  double radius = 0;  ///< radius of the offset arc, mm
  double sense = 1;   ///< sense of the arc: 1 counter-clockwise, −1 clockwise
  double sweep = 0;   ///< remaining sweep, rad, not negative; over 2π for several turns
  double length = 0;  ///< remaining length, mm

  void trim_begin(double by, Vec at);  ///< shortens the piece by `by` mm; `at` is its new beginning
  void trim_end(double by, Vec at);    ///< shortens the piece by `by` mm; `at` is its new end
};

/// Returns the offset line. `aside` in mm, positive to the left. The ends must differ.
OffsetPiece offset_line(Vec from, Vec to, double aside);
/// A programmed arc of the plane; z is ignored.
struct PlaneArc {
  Vec from, to, centre;
  double sense = 1;  ///< 1 counter-clockwise, −1 clockwise
  double sweep = 0;  ///< rad, positive; over 2π for several turns
};
/// Returns the arc offset by `aside` mm, positive to the left; nothing if it is more than `slack` mm too narrow.
std::optional<OffsetPiece> offset_arc(const PlaneArc& arc, double aside, double slack);

/// A crossing of two pieces.
struct Meeting {
  Vec at;
  double before, behind;  ///< lengths cut off: of the first piece behind `at`, of the second piece before it, mm
};
/// Returns the crossing of two pieces that is nearest to the corner between them, if it lies on both, or beyond their
/// other end by at most `slack`, mm.
std::optional<Meeting> meeting(const OffsetPiece& first, const OffsetPiece& second, double slack);

}  // namespace bahnwerk::gcode
