#pragma once
/// Runs NLopt once. No other header or source includes NLopt.
#include <cstddef>
#include <vector>

#include "core/numeric/optimise/evaluator.hpp"

namespace bahnwerk {

/// Why NLopt stopped.
enum class SearchEnd {
  itself,       ///< a tolerance, rounding, or a step that the method could not take
  evaluations,  ///< the budget
  broken,       ///< gradients that are not finite, or a search point that is not
};

/// Searches from `z` (scaled, within the bounds), which becomes NLopt's answer. Exceptions of callbacks and Progress
/// are passed on unchanged, after at most the evaluation in which they were thrown: NLopt is C and must not be unwound,
/// so it is stopped first.
SearchEnd nlopt_search(OptimisationEvaluator& evaluator, const OptimisationOptions& options, double step_tolerance,
                       std::vector<double>& z);

}  // namespace bahnwerk
