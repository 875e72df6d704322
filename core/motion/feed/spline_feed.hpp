#pragma once
/// The source's optimised feed, for comparison: a cubic B-spline of the speed, its control points by sequential
/// quadratic programming in overlapping windows [Herrmann 4.4.3, (4.78)–(4.84), Fig. 4.34].
///
/// Limits are those of PathTask and along the path; as in the source they are looked at in places, eight per span,
/// and the law is slowed at the end by what it exceeds them between. Deviations: the duration itself is the objective,
/// by quadrature, not the sum of the control points (4.78); the parameter, see speed_spline.hpp; jerk along the path is
/// limited, not its norm in space (4.80). No bound comes with it: plan_jerk_limited() is the planner to use.
#include <cstddef>

#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct SplineFeedOptions {
  Limits path;                    ///< the tool's path
  std::size_t spans = 16;         ///< per segment of the path
  std::size_t window = 24;        ///< control points that move at once
  std::size_t overlap = 12;       ///< of them those that the next window moves again
  std::size_t passes = 2;         ///< over the path; the source makes two
  std::size_t evaluations = 400;  ///< of a window, at most
  std::size_t steps = 16;         ///< pieces of the law per span
};

struct SplineFeed {
  TimeLaw law;
  std::size_t evaluations = 0;  ///< of the problem's functions
};

/// At rest at both ends of the path, nowhere else: throws InvalidInput for a task that rests within. Cost: seconds per
/// turn of a winding. Throws Stopped.
SplineFeed plan_spline_feed(const PathTask& task, const SplineFeedOptions& options, Progress& progress, double from,
                            double to);

}  // namespace bahnwerk
