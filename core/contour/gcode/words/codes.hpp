#pragma once
/// What the G words of a part program mean to the reader.
#include <string>

namespace bahnwerk::gcode {

/// Words of one group exclude each other in a line.
enum class Group { motion, plane, units, distance, centres, work, feed_mode, retract, compensation, none };

enum class Action {
  rapid,
  line,
  arc_cw,
  arc_ccw,
  cubic,
  quadratic,
  no_motion,  // group motion
  plane_xy,
  plane_zx,
  plane_yz,
  inch,
  millimetre,
  absolute,
  incremental,
  absolute_centres,
  incremental_centres,
  cycle,
  retract_to_start,
  retract_to_r,
  compensation_off,
  compensation_left,
  compensation_right,
  work_offset,
  local_offset,
  set_position,
  reset_position,
  restore_position,
  set_data,
  per_minute,
  inverse_time,
  dwell,
  reference_point,
  store_reference,
  machine_coordinates,
  path_control,
  tool_length,
  cancel,  ///< of what is never in force: scaling, mirroring
  printer,
  nothing,  ///< has no effect on a contour, or states what holds anyway
  refuse,
};

struct Code {
  Group group;
  Action action;
  const char* text;  ///< why it is refused, what its note says
};

/// `tenfold`: G5.1 is 51. Unknown words are refused.
Code meaning(int tenfold);
/// Whether the G word takes words of its line: coordinates, a time, an offset.
bool takes_words(int tenfold);
/// M words that this reader gives a meaning. What stands behind another one in its line is that word's own.
bool known_m(int m);
/// M words of printers' firmware that a machine tool does not know.
bool printer_m(int m);
/// What such a word would change of the motion, for its note; null where it concerns the motion in no way.
const char* printer_effect(int m);
/// The M word without its decimal, by its entry in Line::m.
inline int whole_m(int m) { return m < 0 ? -m / 10 : m; }
/// "M862.3", by its entry in Line::m.
std::string m_name(int m);
/// "G5.1"
std::string name(int tenfold);

}  // namespace bahnwerk::gcode
