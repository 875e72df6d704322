#pragma once
/// The problem "smallest largest violation" of another problem.
#include "core/numeric/optimise/optimise.hpp"

namespace bahnwerk {

/// Minimises s ≥ 0 over (x, s) under cᵢ(x) ≤ s for inequalities and ±cᵢ(x) ≤ s for equalities, in their scales; bounds
/// are unchanged. It has feasible points for any constraints. It refers to `problem`, which has to outlive it.
OptimisationProblem elastic_problem(const OptimisationProblem& problem);

}  // namespace bahnwerk
