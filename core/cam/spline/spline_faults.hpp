#pragma once
/// Faults of a spline's conditions, at the places of the document where they are.
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/cam/problem.hpp"
#include "core/cam/spline/spline_system.hpp"

namespace bahnwerk::cam {

/// Returns "position", "velocity", "acceleration", "jerk", "derivative of order 5".
std::string order_name(int order);
/// Returns {"points", "3", "velocity"} or {"points", "3", "derivatives", "5"}.
std::vector<std::string> value_place(std::size_t point, int order);

/// Returns the faults of sections whose conditions ask for more than degree 21, or for none.
InvalidInput degree_faults(const MotionLawProblem& problem, const SplineTask& task, int least_maximum);
/// Returns the faults of a system whose conditions repeat or contradict each other while others are missing.
InvalidInput singular_faults(const MotionLawProblem& problem, const SingularSystem& why);

}  // namespace bahnwerk::cam
