#pragma once
/// One run of NLopt. The only file pair that knows it.
#include <cstddef>
#include <vector>

#include "core/numeric/optimise/evaluator.hpp"

namespace bahnwerk {

enum class SearchEnd {
  itself,       ///< a tolerance, rounding, or a step that the method could not take
  evaluations,  ///< the budget
  broken,       ///< gradients that are not finite, or the method went to a point that is not
};

/// Searches from `z` (scaled, within the bounds), which becomes NLopt's answer. What callbacks and Progress throw comes
/// out unchanged, after at most the evaluation in which it was thrown: NLopt is C and must not be unwound, so it is
/// stopped first.
SearchEnd nlopt_search(OptimisationEvaluator& evaluator, const OptimisationOptions& options, double step_tolerance,
                       std::vector<double>& z);

}  // namespace bahnwerk
