#pragma once
/// The verifier of any motion of axes over time. It uses the motion's states and polynomials and no planner.
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Inputs of the checks.
struct MotionToVerify {
  const Motion& motion;
  const std::vector<AxisLimits>& axes;  ///< limits, names and units, one per axis of the motion
  int continuous = 1;  ///< derivative up to which pieces have to be continuous: 1 velocity, 2 acceleration, 3 jerk
  bool rests_at_begin = true, rests_at_end = true;
  /// Error of the motion's states in time beyond rounding, s: 0 for polynomials. Along a path u(s) is accurate to 1e-10
  /// of a segment's length, so it is that length over the speed.
  double resolution = 0;
  /// Returns the allowed jump of derivative `derivative` (0 position, 1 velocity, 2 acceleration) of an axis where
  /// pieces meet at time t, as where the tangent of its path jumps; empty: no jump.
  std::function<double(std::size_t axis, std::size_t derivative, double t)> step = {};
  std::string group = {};     ///< subject of the checks of all axes together
  std::string unit = "unit";  ///< unit of these checks: that of the axes, if they share one
};

/// Returns these checks, in this order. For each limited axis: `range <axis>` (excess of positions over lowest and
/// highest, against 32 ε of the position), `velocity <axis>`, `acceleration <axis>`, `jerk <axis>`, `snap <axis>`
/// (fails if the motion has no snap); then `continuity of position`, `… velocity`, `… acceleration`, `… jerk` up to
/// `continuous`, `start at rest`, `end at rest` (with velocity every derivative that has to be continuous). Units of
/// the latter are those of the axis that is closest to its tolerance.
///
/// For pieces that are polynomials (Motion::polynomial) every peak and range is an enclosure, up to rounding: Bernstein
/// coefficients over the piece, subdivided until the peak is known to 1e-13. Peaks of other pieces are found by
/// interpolation (core/numeric/peak.hpp), resolved to 2e-11 of the limit. A limit holds when value ≤ limit · (1 +
/// 1e-9). Continuity and rest are held to the rounding of a piece of duration T: 32 ε (|x| + |v| T + |a| T²/2 + |j|
/// T³/6) and its derivatives, from both sides, and to |x′| (ε t + resolution) for the error of t; where an axis is no
/// polynomial to the largest of these over all axes, since components of a tangent are rounded. A value that is not a
/// number fails.
///
/// Cost: O(pieces · axes), about 0.2 µs per polynomial and derivative. Throws std::invalid_argument if the numbers of
/// axes differ, and passes exceptions of `progress` on.
std::vector<Check> motion_checks(const MotionToVerify& input, Progress progress);

}  // namespace bahnwerk
