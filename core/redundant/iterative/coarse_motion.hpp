#pragma once
/// Assembles the splines of the coarse axes, each with knots of its own, to one motion.
#include <memory>
#include <vector>

#include "core/machine/limits.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// Returns the motion of all axes, which ends at `duration`, s; the splines end there up to rounding. O(pieces of all).
///
/// If `limits` are given, every piece begins exactly with the position and velocity with which the one before ends, and
/// with its acceleration if jerk is limited. Differences of the splines at knots are due to rounding; they are
/// distributed over pieces long enough for the correction to need no more than 1e-10 of the acceleration or jerk limit.
std::shared_ptr<const SplineMotion> coarse_motion(const std::vector<TimeSpline>& axes, double duration,
                                                  const std::vector<Limits>& limits = {});

}  // namespace bahnwerk
