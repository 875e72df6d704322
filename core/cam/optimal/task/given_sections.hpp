#pragma once
/// Sections of a classical law in a task of method `optimal`: their laws are known before anything is optimised.
///
/// A given section ends in states that are numbers: its derivatives up to a point's continuity become conditions of the
/// free section on the other side, and what the document asks for at such a point is checked against the given law. Its
/// peaks bound the peaks of the whole law from below, and so J. The program stays convex; it splits into one program
/// per run of free sections, which share the peaks alone. The angles at its ends may be in ranges if it stretches: its
/// peaks of order r then fall with its length T like 1/T^r.
#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

/// Returns whether a classical section is the same law, stretched, at whatever angles its points have: it rests at both
/// ends, with all derivatives that its neighbours share with it, and has no limits that depend on its duration.
bool section_stretches(const MotionLawProblem& problem, std::size_t section);

/// Fills `given`, replaces the conditions at the ends of given sections, frees the limits of given sections once they
/// hold. Does nothing if no point names a law. Throws InvalidInput as classical_sections() does, and where a given
/// section leaves its own limits.
void add_given_sections(const MotionLawProblem& problem, LawTask& task);

}  // namespace bahnwerk::cam
