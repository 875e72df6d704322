#pragma once
/// What the G words of a part program mean to the reader.
#include <string>

namespace bahnwerk::gcode {

/// Words of one group exclude each other in a line.
enum class Group { motion, plane, units, distance, centres, none };

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
  dwell,
  machine_point,
  path_control,
  tool_length,
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
/// "G5.1"
std::string name(int tenfold);

}  // namespace bahnwerk::gcode
