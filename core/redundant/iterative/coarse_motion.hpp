#pragma once
/// Coarse axes, each a spline with knots of its own, as one motion.
#include <memory>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

/// Ends at `duration`, which the splines end at but for rounding. O(pieces of all).
std::shared_ptr<const SplineMotion> coarse_motion(const std::vector<TimeSpline>& axes, double duration);

}  // namespace bahnwerk
