#pragma once
/// Why no law exists: which values contradict each other, which ranges and section limits cannot hold.
#include "core/base/progress.hpp"
#include "core/cam/optimal/program/law_basis.hpp"
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

/// Throws InvalidInput where a section's limits leave nothing of what the points at its ends ask for. `given` is the
/// problem as the user wrote it, whose straight sections have no limits.
void check_contradictions(const MotionLawProblem& problem, const MotionLawProblem& given);

/// Throws InvalidInput where a section is too short for published coefficients of that degree (is_expressible()).
void check_lengths(const MotionLawProblem& problem, const LawTask& task, int degree);

/// Throws InvalidInput with the values, ranges and limits that stand against each other, by the multipliers of the
/// program "least violation" (a Farkas certificate), or with the word that the method did not converge where nothing
/// does. `all_degrees`: none of the degrees and pieces has a law.
[[noreturn]] void explain_infeasible(const LawTask& task, const LawBasis& basis, const std::vector<double>& times,
                                     Progress progress, bool all_degrees = false);

}  // namespace bahnwerk::cam
