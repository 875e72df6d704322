#pragma once
/// Which lines of a program cost most time, and what keeps them from going faster.
#include <cstddef>
#include <string>
#include <vector>

#include "core/machine/machine.hpp"

namespace bahnwerk {

class PathMotion;
class Progress;

struct SlowLine {
  std::size_t source = 0;  ///< of the path's segments: a program's line, else the segment's number in the document
  double time = 0;         ///< s
  double share = 0;        ///< of the whole motion's time
  double length = 0;       ///< mm
  double feed = 0;         ///< mm/s that is asked for, the largest of its segments; infinite where none is
  /// What binds for most of its time: "feed", "velocity x", "acceleration y", "jerk z", "path acceleration", "path
  /// jerk", "dwell", or "" where nothing comes within 5 % of its limit: a braking reserve, or a limit between two
  /// switches.
  std::string limit;
  double limit_share = 0;  ///< of the line's time for which it binds
  bool stops = false;      ///< whether the motion rests on it or at one of its ends
};

/// The `count` slowest, slowest first; of equal ones the earlier. `feeds` per segment of the path; `along`: limits of
/// the path that the motion holds. O(pieces), and one evaluation of the path per piece of the lines returned. Calls
/// progress every few ms.
std::vector<SlowLine> slow_lines(const PathMotion& motion, const Machine& machine, const std::vector<double>& feeds,
                                 const Limits& along, std::size_t count, Progress& progress, double progress_at);

}  // namespace bahnwerk
