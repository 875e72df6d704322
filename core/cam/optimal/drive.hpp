#pragma once
/// The shortest cycle of a law within a drive's velocity, acceleration and jerk.
///
/// M(T) is the minimum, over all laws of the degree with a cycle of duration T, of the largest ratio of a peak to its
/// limit: a linear program with one shared peak, solved with its dual bound. T is long enough exactly if M(T) ≤ 1. If
/// no point asks for a derivative other than 0, a stretched law is a law, too. M then falls with T and the search is a
/// proof: below `too_short` the dual bound says M > 1.
#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

struct ShortestCycle {
  double duration = 0;   ///< duration of the law's cycle, s
  double too_short = 0;  ///< s; no law of this degree is within the limits in this time or, where monotone, in less
  bool monotone = true;  ///< whether M falls with T
  SplineResult spline;   ///< the spline in the units of the task with `duration`
  int degree = 0, pieces = 1;
  int programs = 0;
};

/// Throws InvalidInput where no law exists at any duration that was tried.
ShortestCycle find_shortest_cycle(const MotionLawProblem& problem, Progress& progress);

}  // namespace bahnwerk::cam
