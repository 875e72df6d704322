#pragma once
/// How far a point is from a local minimum, to first order.
#include "core/numeric/optimise/evaluator.hpp"

namespace bahnwerk {

/// The residual of the Karush-Kuhn-Tucker conditions at a point with gradients, as OptimisationResult::kkt_residual
/// states it; feasibility is apart. Multipliers: least squares over the equalities and over the inequalities and bounds
/// within 1e-3 (scaled) of being active; leaving the others out can only raise the residual. Throws what Progress
/// throws.
double kkt_residual(OptimisationEvaluator& evaluator, const OptimisationPoint& point);

}  // namespace bahnwerk
