#pragma once
/// The verifier of any motion of axes over time, wherever it comes from: it asks for states and polynomials, no
/// planner.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

class Progress;

struct MotionToVerify {
  const Motion& motion;
  const std::vector<AxisLimits>& axes;  ///< limits, names and units, one per axis of the motion
  int continuous = 1;  ///< up to which derivative pieces fit together: 1 velocity, 2 acceleration, 3 jerk
  bool rests_at_begin = true, rests_at_end = true;
  /// s; how far off in time the states may be that the motion gives, beyond rounding: 0 for polynomials. Along a path
  /// u(s) is known to 1e-10 of a segment's length, so this is that over the speed.
  double resolution = 0;
  /// By how much derivative `derivative` (0 position, 1 velocity, 2 acceleration) of an axis may jump where pieces meet
  /// at time t, as an axis' does where the tangent of its path jumps; none: not at all.
  std::function<double(std::size_t axis, std::size_t derivative, double t)> step = {};
  double progress_from = 0, progress_to = 1;  ///< the share of the whole job's progress that this takes
  std::string group = {};                     ///< the subject of checks of all axes together
  std::string unit = "unit";                  ///< their unit: that of the axes, if they have the same one
};

/// Checks, in this order, per axis where limited: `range <axis>` (by how much positions lie beyond lowest and highest,
/// against 32 ε of the position), `velocity <axis>`, `acceleration <axis>`, `jerk <axis>`, `snap <axis>` (fails where
/// the motion does not know its snap); then `continuity of position`, `… velocity`, `… acceleration`, `… jerk` as far
/// as asked for, `start at rest`, `end at rest` (with velocity every derivative that has to be continuous). Units of
/// those are those of the axis that strains its tolerance most.
///
/// Of pieces that are polynomials (Motion::polynomial) every peak and range is an enclosure, up to rounding: Bernstein
/// coefficients over the piece, subdivided until they decide, to 1e-13. Of others peaks are found by interpolation
/// (core/numeric/peak.hpp), resolved to 2e-11 of the limit. A limit holds when value ≤ limit · (1 + 1e-9). Continuity
/// and rest are held to what rounding does to a piece of duration T: 32 ε (|x| + |v| T + |a| T²/2 + |j| T³/6) and its
/// derivatives, from both sides, and to |x′| (ε t + resolution) for what t itself is off by; where an axis is no
/// polynomial to the largest of that of all axes, as components of a tangent are rounded. Not a number fails.
///
/// Cost: O(pieces · axes), about 0.2 µs per polynomial and derivative. Throws std::invalid_argument where the numbers
/// of axes differ, and what progress throws.
std::vector<Check> motion_checks(const MotionToVerify& input, Progress& progress);

}  // namespace bahnwerk
