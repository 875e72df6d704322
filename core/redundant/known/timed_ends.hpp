#pragma once
/// Ends of a reparametrised motion [Bock 5.2.3]: all axes rest there, so the rate of the old time need not be 0.
#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/known/timed_path.hpp"

namespace bahnwerk {

/// Returns `rate`, a law over the old time that begins and ends at rest, with a positive rate λ = dt/dτ at both ends.
/// As all axes rest there, only accelerations limit the rate, λ² |ẅ| ≤ A. From one of the last eight pieces on, λ keeps
/// the value that it has at that piece's begin; up to one of the first eight, it has the value at that piece's end.
/// These pieces are chosen so that the motion is shortest and the limits hold at four places of each constant piece.
TimeLaw with_moving_ends(const TimeLaw& rate, const TimedPath& path, const Machine& axes);

}  // namespace bahnwerk
