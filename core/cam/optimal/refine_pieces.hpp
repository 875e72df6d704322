#pragma once
/// Pieces of a law that lies at its limits: they are halved where its jerk changes.
///
/// A shortest law has constant derivatives between the times at which it goes from one limit to another; it loses at
/// most about one piece around each of these times. Halving the pieces at the changes halves that, and the number of
/// pieces grows by the number of changes alone.
#include <vector>

#include "core/cam/optimal/program/spline_program.hpp"

namespace bahnwerk::cam {

/// Returns the basis with pieces halved at which the jerk of the law changes by more than a tenth of its peak, inside
/// or at an end, as far as published coefficients can tell the shorter pieces' derivatives from rounding, acceleration
/// to 1e-10 of its peak, and to a thousandth of the section where no jerk is limited: it would grow without end. The
/// same number of pieces if there are none.
LawBasis halve_at_changes(const LawTask& task, const LawBasis& basis, const SplineResult& spline);

}  // namespace bahnwerk::cam
