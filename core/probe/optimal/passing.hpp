#pragma once
/// The points that a motion passes beside those at which it was planned to be at given times.
#include <cstddef>
#include <vector>

#include "core/motion/axes/spline_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

struct Passing {
  std::vector<double> times;      ///< s, per point of the problem, ascending
  std::vector<std::size_t> open;  ///< edges of `chosen` between whose points a point or an edge's tube is missed
};

/// Finds when `motion` passes the points. `chosen` are indices of points, the first and the last one among them, that
/// it passes at `times`. Each other point is passed where the motion is nearest to it, or earlier or later within
/// point_tolerance where the order of the points asks for it: points are passed in order where none has to be left
/// before one ahead of it is reached. A point is missed where a given point that it stands for is farther than
/// point_tolerance from the motion at that time; the tube of an edge is missed where the motion leaves it between the
/// times of its ends. O(points + pieces), some ten µs each.
Passing pass_points(const ProbeProblem& problem, const SplineMotion& motion, const std::vector<std::size_t>& chosen,
                    const std::vector<double>& times);

}  // namespace bahnwerk
