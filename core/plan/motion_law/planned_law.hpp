#pragma once
/// A law by the method that the problem names, with its lower bound.
#include <optional>
#include <string>

#include "core/base/progress.hpp"
#include "core/cam/solution.hpp"

namespace bahnwerk {

struct PlannedLaw {
  cam::LawSolution solution;
  double lower = 0;   ///< lower bound of J: no law of whatever degree and angles has less
  std::string basis;  ///< method that proves the bound, for people
  /// `optimal` with fixed angles in a known cycle: the law of `active_set`, where there is one.
  std::optional<cam::LawSolution> source;
};
/// `optimal` is never worse than `active_set` where both have the same degree: it takes that law where its J is
/// smaller. Throws InvalidInput, and Infeasible where `active_set` has no law.
PlannedLaw plan_law(const cam::MotionLawProblem& problem, Progress progress);

/// Returns a bound that costs nothing: between two points the mean velocity is reached. 0 if positions are not given.
double mean_velocity_bound(const cam::MotionLawProblem& problem);

}  // namespace bahnwerk
