#pragma once
/// The shortest cycle of a law within a drive's velocity, acceleration and jerk.
///
/// M(T) is the minimum, over all laws of the degree with a cycle of duration T, of the largest ratio of a peak to its
/// limit: a linear program with one shared peak. T is long enough exactly if M(T) ≤ 1. Where the document names no
/// degree, pieces are halved at the changes of the jerk (refine_pieces.hpp) as long as M falls by more than 1e-4.
/// Angles in ranges and the cycle are sought in turn: the angles that make M least in a cycle, then the cycle at these
/// angles. If no point asks for a derivative other than 0, a stretched law is a law, too, and M falls with T: where the
/// relaxation over all laws (relaxation.hpp) has M > 1 at some T, no law has a shorter cycle.
#include <optional>
#include <utility>

#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/solution.hpp"

namespace bahnwerk::cam {

struct ShortestCycle {
  explicit ShortestCycle(LawBasis first) : basis(std::move(first)) {}
  double duration = 0;              ///< duration of the law's cycle, s
  SplineResult spline;              ///< the spline in the units of the task with `duration`
  std::optional<CycleBound> bound;  ///< none where a stretched law is no law
  LawBasis basis;                   ///< basis of the spline
  int programs = 0;
};

/// Throws InvalidInput where the drive has no limit, a point asks for more than the drive can, or nothing has to move.
void check_drive(const MotionLawProblem& problem);

/// Finds the cycle of a problem that check_drive() has passed. Throws InvalidInput where no law exists at any duration
/// that was tried.
ShortestCycle find_shortest_cycle(const MotionLawProblem& problem, Progress progress);

}  // namespace bahnwerk::cam
