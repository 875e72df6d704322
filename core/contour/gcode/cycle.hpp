#pragma once
/// The modal words of canned cycles (G73, G81 … G89), and one of their holes.
#include <cstddef>
#include <optional>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::gcode {

/// Axes of a cycle in G17, G18, G19; the hole is drilled along the last one.
struct CycleAxes {
  std::size_t a, b, depth;
};

/// A level along the depth axis, mm: of the program, or with G91 an increment. Its meaning is that of its own line.
struct CycleLevel {
  double value;
  bool absolute;
};

/// Words hold for the following lines of the cycle.
struct Cycle {
  int code = 0;  ///< 81 for G81; 0: no cycle is active
  std::optional<CycleLevel> r, depth;
  std::optional<double> peck, dwell;  ///< mm, s
  std::optional<double> clearance;    ///< P of G73 and G83, mm: height above the last depth at which the feed begins
  bool back_to_start = true;          ///< G98: retract to the level at which the series began, if that is above R
  std::optional<double> start_level;  ///< level along the depth axis, mm, of the active series
};

/// mm in the coordinates of the contour.
struct CycleHole {
  CycleAxes axes;
  Vec at, step;  ///< the first hole and the vector to the next one
  std::size_t repeats = 1;
  double r = 0, bottom = 0, peck = 0, clear = 0;
};

}  // namespace bahnwerk::gcode
