#pragma once
/// Classical laws in a document for method `optimal`. A straight section, a dwell or a synchronous one, is a limit of
/// velocity that is a number: it stays convex and is planned with the others. The other laws are given sections
/// (given_sections.hpp).
#include "core/cam/problem.hpp"

namespace bahnwerk::cam {

/// Throws InvalidInput, naming every field that excludes a plan and what to write instead: a classical law other than
/// straight whose section begins or ends at an angle in a range and does not stretch (given_sections.hpp); what
/// with_straight_sections() and classical_sections() refuse, at any duration of the cycle where that is not known;
/// still points with nothing but classical laws between them.
void check_classical_sections(const MotionLawProblem& problem);

/// Returns the problem with each straight section as a limit of its velocity, rise by duration, and without its law;
/// other laws stay, and begin or end with the velocity of a straight section beside them. Needs the cycle's duration
/// unless straight sections are dwells. Throws InvalidInput for a straight section between positions that are no
/// numbers, between angles in ranges, or in a cycle whose duration is not known yet.
MotionLawProblem with_straight_sections(const MotionLawProblem& problem);

}  // namespace bahnwerk::cam
