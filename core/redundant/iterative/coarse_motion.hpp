#pragma once
/// Coarse axes, each a spline with knots of its own, as one motion.
#include <memory>
#include <vector>

#include "core/machine/limits.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// Ends at `duration`, which the splines end at but for rounding. O(pieces of all).
///
/// With limits of each axis every piece begins with the position and velocity that the one before ends with, to the
/// last bit, where jerk is limited with the acceleration, too. What the splines differ by at their knots, by rounding,
/// is made up for within pieces that are long enough for it to take no more than 1e-10 of the acceleration, or jerk.
std::shared_ptr<const SplineMotion> coarse_motion(const std::vector<TimeSpline>& axes, double duration,
                                                  const std::vector<Limits>& limits = {});

}  // namespace bahnwerk
