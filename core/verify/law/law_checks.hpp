#pragma once
/// Checks of a law in closed form: path velocity against the feeds, rest, continuity, order and coverage.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/verify/law/verifier.hpp"

namespace bahnwerk::verify {

/// Checks of the law against the path's joints and feeds, in the order that verify_motion() documents. O(pieces +
/// segments).
std::vector<Check> law_checks(const VerifierInput& input, ProgressScope& progress);

}  // namespace bahnwerk::verify
