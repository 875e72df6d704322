#pragma once
/// The lines of a program that take most time, and the limit that keeps each from being faster.
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

class PathMotion;

/// What keeps a motion from being faster.
struct ActiveLimit {
  /// none: nothing comes within 5 % of its limit, because of a braking reserve or a limit between two switches.
  enum class Kind { none, feed, axis, path, dwell } kind = Kind::none;
  int order = 0;          ///< limited derivative of the axis or along the path
  std::string axis = {};  ///< name of the axis
};

struct SlowLine {
  std::size_t source =
      0;              ///< source of the path's segments: a program's line, else the segment's number in the document
  double time = 0;    ///< s
  double share = 0;   ///< share of the motion's duration
  double length = 0;  ///< mm
  double feed = 0;    ///< mm/s, largest requested feed of its segments; infinite where none is requested
  ActiveLimit limit;  ///< the one that is active for most of its time
  double limit_share = 0;  ///< share of the line's time in which that limit is active
  bool stops = false;      ///< whether the motion rests on the line or at one of its ends
};

/// Returns the `count` lines that take most time in descending order, the earlier of equal ones first. `feeds` are per
/// segment of the path, mm/s; `along` are the limits of the path that the motion keeps. Cost: O(pieces), and one
/// evaluation of the path per piece of the returned lines. Asks `progress` every few ms.
std::vector<SlowLine> slow_lines(const PathMotion& motion, const Machine& machine, const std::vector<double>& feeds,
                                 const Limits& along, std::size_t count, Progress progress);

}  // namespace bahnwerk
