#pragma once
/// Classical laws in a document for method `optimal`. A straight section, a dwell or a synchronous one, is a limit of
/// velocity that is a number: it stays convex and is planned with the others. Other laws are refused.
#include "core/cam/problem.hpp"

namespace bahnwerk::cam {

/// The same problem with each straight section as a limit of its velocity, rise by duration, and without laws. Needs
/// the cycle's duration unless straight sections are dwells. Throws InvalidInput, naming every law that is in the way
/// and what to write instead: another law than straight; a straight one between positions that are no numbers, between
/// angles in ranges, or in a cycle whose duration is not known yet.
MotionLawProblem with_straight_sections(const MotionLawProblem& problem);

}  // namespace bahnwerk::cam
