#pragma once
/// Methods that filter a head's motion in time [Bock 3.3, 3.4]: the limits of that reference motion are searched until
/// what comes out of the filter holds the limits of coarse and fine axes. The source leaves that to trials by hand.
///
/// Velocity and acceleration of the reference start with the sums of both axes' limits and fall by the largest quotient
/// of a peak and its limit: the velocity's with velocities, the acceleration's with accelerations, and both with the
/// offset; then by a fraction of a percent at a time. Slower motions are filtered to smaller peaks in the end, so it
/// ends.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

struct FilterSearch {
  double lead = 0, tail = 0;  ///< s that the head stands before and after
  /// Control points of the coarse spline (cycle_spline.hpp) from the head's positions at the same times, `step` s
  /// apart.
  std::function<std::vector<double>(const std::vector<double>& x, double step)> filter;
};

/// Throws what the planner throws; Infeasible where 200 passes found no valid split.
RedundancyResult search_reference(const RedundancyTask& task, const RedundancyOptions& options,
                                  const FilterSearch& search, Progress& progress, double from, double to);

}  // namespace bahnwerk
