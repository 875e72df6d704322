#pragma once
/// The meaning of the G words of a part program.
#include <string>

namespace bahnwerk::gcode {

/// Words of one group exclude each other in a line.
enum class Group { motion, plane, units, distance, centres, work, feed_mode, retract, compensation, none };

/// The effect of a G word.
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
  cancel,  ///< cancels modes that are never active: scaling, mirroring
  printer,
  nothing,  ///< has no effect on a contour, or states a default
  refuse,
};

/// A G word's group, effect and text.
struct Code {
  Group group;
  Action action;
  const char* text;  ///< reason of the refusal, or text of the note
};

/// Returns the meaning of ten times a G word: G5.1 is 51. Unknown words are refused.
Code meaning(int tenfold);
/// Returns whether the G word takes words of its line: coordinates, a time, an offset.
bool takes_words(int tenfold);
/// Returns whether this reader interprets the M word. The words behind another M word in its line belong to that word.
bool known_m(int m);
/// Returns whether it is an M word of printers' firmware that a machine tool does not have.
bool printer_m(int m);
/// Returns the effect of such a word on the motion, for its note; null if it has none.
const char* printer_effect(int m);
/// Returns the M word without its decimal, by its entry in Line::m.
inline int whole_m(int m) { return m < 0 ? -m / 10 : m; }
/// Returns "M862.3", by its entry in Line::m.
std::string m_name(int m);
/// Returns "G5.1" for 51.
std::string name(int tenfold);

}  // namespace bahnwerk::gcode
