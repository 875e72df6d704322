#pragma once
/// Finds contradictions in a motion law's document that no method can resolve.
#include <vector>

#include "core/base/errors.hpp"
#include "core/plan/motion_law/law_plan.hpp"

namespace bahnwerk::api::motion_law {

/// Returns the faults of the problem: empty ranges, angles that cannot ascend, ends of an open law, degrees above 21,
/// sections that do not exist, weights, drive and vibration without what they need. Places are relative to the spec.
std::vector<InputFault> problem_faults(const cam::MotionLawProblem& problem);
/// Returns the faults of the table: a cycle time that does not divide the cycle, tables that are too long.
std::vector<InputFault> sampling_faults(const cam::MotionLawProblem& problem, const LawSampling& sampling);

}  // namespace bahnwerk::api::motion_law
