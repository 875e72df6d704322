#pragma once
/// Why no law exists: which values contradict each other, which ranges and section limits cannot hold.
#include "core/cam/optimal/law_task.hpp"
#include "core/cam/optimal/program/section_basis.hpp"

namespace bahnwerk {
class Progress;
}
namespace bahnwerk::cam {

/// Throws InvalidInput where a section's limits leave nothing of what the points at its ends ask for.
void check_contradictions(const MotionLawProblem& problem);

/// Throws InvalidInput with the values, ranges and limits that stand against each other, by the multipliers of the
/// program "least violation" (a Farkas certificate); returns where a law exists after all.
void explain_infeasible(const LawTask& task, const SectionBasis& basis, const std::vector<double>& times,
                        Progress& progress);

}  // namespace bahnwerk::cam
