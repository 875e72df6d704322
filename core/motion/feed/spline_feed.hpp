#pragma once
/// The source's optimised feed, for comparison: a cubic B-spline of the speed, whose control points are found by
/// sequential quadratic programming in overlapping windows [Herrmann 4.4.3, (4.78)–(4.84), Fig. 4.34].
///
/// Limits are those of PathTask and along the path. As in the source they are evaluated at eight places per span; the
/// law is finally slowed by its excess between them. Deviations: the objective is the duration, by quadrature, not the
/// sum of the control points (4.78); the parameter is that of speed_spline.hpp; jerk along the path is limited, not its
/// norm in space (4.80). The method gives no bound; plan_jerk_limited() is the planner to use.
#include <cstddef>

#include "core/base/progress.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The options of plan_spline_feed().
struct SplineFeedOptions {
  Limits path;                    ///< limits along the tool's path
  std::size_t spans = 16;         ///< spans of the spline per segment of the path
  std::size_t window = 24;        ///< number of control points that are variables of a window
  std::size_t overlap = 12;       ///< number of these that are variables of the next window, too
  std::size_t passes = 2;         ///< number of sweeps over the path; the source makes two
  std::size_t evaluations = 400;  ///< largest number of evaluations per window
  std::size_t steps = 16;         ///< pieces of the law per span
};

/// The law, with the effort of the search.
struct SplineFeed {
  TimeLaw law;
  std::size_t evaluations = 0;  ///< evaluations of the problem's functions
};

/// Plans a law that rests at both ends of the path and nowhere else. Throws InvalidInput for a task with rests between,
/// and Stopped. Cost: seconds per turn of a winding.
SplineFeed plan_spline_feed(const PathTask& task, const SplineFeedOptions& options, Progress progress);

}  // namespace bahnwerk
