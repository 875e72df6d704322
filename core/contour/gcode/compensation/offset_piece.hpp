#pragma once
/// A line or an arc of the plane, moved aside by a cutter's radius, and where two of them meet.
#include <optional>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::gcode {

/// To the left of a direction, mm; z is left out.
inline Vec left_of(Vec direction) { return {-direction.y, direction.x, 0}; }
inline double turn_of(Vec from, Vec to) {  ///< rad, within ±π, counter-clockwise positive
  return std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
}
Vec turned(Vec direction, double angle);  ///< counter-clockwise, rad

/// All in the plane (z = 0). `radius` 0 and `sweep` 0: a line; an arc that has shrunk to its centre has no length.
struct OffsetPiece {
  Vec from, to;     ///< moved aside, and trimmed
  Vec corner_from;  ///< as programmed
  Vec corner_to;
  Vec direction_from;  ///< unit tangents at both ends
  Vec direction_to;
  bool arc = false;
  Vec centre;
  double radius = 0;  ///< of the arc moved aside
  double sense = 1;   ///< of the arc: 1 counter-clockwise, −1 clockwise
  double sweep = 0;   ///< that is left of it, rad, not negative; over 2π for several turns
  double length = 0;  ///< that is left of it, mm

  void trim_begin(double by, Vec at);  ///< mm along the piece; `at`: where it begins then
  void trim_end(double by, Vec at);
};

/// `aside`: mm, positive to the left. The ends must differ.
OffsetPiece offset_line(Vec from, Vec to, double aside);
/// An arc by its centre, `sweep` > 0. None where it is more than `slack` mm too narrow to be moved aside.
std::optional<OffsetPiece> offset_arc(Vec from, Vec to, Vec centre, double sense, double sweep, double aside,
                                      double slack);

struct Meeting {
  Vec at;
  double before, behind;  ///< how much of the first piece lies behind it, of the second one before it, mm
};
/// The crossing of two pieces that is nearest to the corner between them, where it lies on both of them, or beyond
/// their other end by at most `slack`, mm.
std::optional<Meeting> meeting(const OffsetPiece& first, const OffsetPiece& second, double slack);

}  // namespace bahnwerk::gcode
