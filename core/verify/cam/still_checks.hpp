#pragma once
/// Checks residual vibration at points where the law is to be still.
#include "core/base/verification.hpp"
#include "core/cam/problem.hpp"

namespace bahnwerk {

struct LawToVerify;

namespace verify {

/// Adds `residual vibration`: what a mode at rest at one still point (an open law: at its begin) has left at the next
/// one, |∫ s″ e^{(ζω + iω_d)(t − t1)} dt| ω, in parts of the peak acceleration that stays as long as a period.
void check_still_points(const cam::MotionLawProblem& problem, const LawToVerify& law, Verification& out);

}  // namespace verify
}  // namespace bahnwerk
