#pragma once
/// A lower bound of J over all laws, of whatever degree and with whatever angles in their ranges: the relaxation over
/// boxes of angles.
#include <cstddef>
#include <limits>

#include "core/base/progress.hpp"
#include "core/cam/optimal/relaxation/known_law.hpp"
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

struct AllLawsBound {
  double objective = 0;
  std::size_t programs = 0;  ///< number of programs solved
  bool complete = true;      ///< the boxes left do not matter at the asked gap
};
/// Bounds J over all angles in their ranges by branch and bound over boxes of angles, best first, with at most
/// `programs` convex programs. It stops when no box has a bound more than `gap` below the known law, or all have one
/// above `enough`. It is deterministic: it counts programs, not time.
AllLawsBound bound_over_angles(const LawTask& task, const KnownLaw& law, std::size_t programs, double gap,
                               Progress progress, double enough = std::numeric_limits<double>::infinity());

}  // namespace bahnwerk::cam
