#pragma once
/// First-order optimality of a point.
#include "core/numeric/optimise/evaluator.hpp"

namespace bahnwerk {

/// Returns the residual of the Karush-Kuhn-Tucker conditions at a point with gradients, as
/// OptimisationResult::kkt_residual defines it; feasibility is separate. Multipliers are found by least squares over
/// the equalities and over the inequalities and bounds within 1e-3 (scaled) of being active; leaving the others out can
/// only raise the residual. Throws what Progress throws.
double kkt_residual(OptimisationEvaluator& evaluator, const OptimisationPoint& point);

}  // namespace bahnwerk
