#pragma once
/// Search for the reference motion of methods that filter the head in time [Bock 3.3, 3.4]: its limits fall until the
/// filtered coarse motion and the remaining fine motion keep all limits. The source finds them by trial.
///
/// The reference's limits of velocity and acceleration start with the sums of both axes' limits. In each pass they fall
/// by the largest quotient of a peak and its limit: the velocity limit because of velocities, the acceleration limit
/// because of accelerations, both because of the offset x − x_c; close to the solution they fall by a fraction of a
/// percent per pass. The search terminates, because slower references have smaller peaks after the filter.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// The filter of a method.
struct FilterSearch {
  double lead = 0, tail = 0;  ///< s, rests of the head before and after the motion
  /// Returns the control points of the coarse spline (cycle_spline.hpp) for the head's positions x, mm, which are
  /// `step` s apart.
  std::function<std::vector<double>(const std::vector<double>& x, double step)> filter;
};

/// Returns the first valid split; no_reference after 200 passes. Throws what the head's planner throws.
Expected<RedundancyResult, NoPlan> search_reference(const RedundancyTask& task, const RedundancyOptions& options,
                                                    const FilterSearch& search, Progress progress);

}  // namespace bahnwerk
