#pragma once
/// How fast the old time goes at both ends of a motion that is timed again [Bock 5.2.3].
#include "core/machine/machine.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/known/timed_path.hpp"

namespace bahnwerk {

/// `rate`, a law over the old time that begins and ends at rest as planners of laws do, with ends in motion: all axes
/// stand there anyway, so what bounds dt/dτ are their accelerations, λ² |ẅ| ≤ A. From one of the last eight pieces on λ
/// stays what it is there, and up to one of the first eight it is what it is behind, wherever that is quickest and
/// within the limits at four places of each of these pieces.
TimeLaw with_moving_ends(const TimeLaw& rate, const TimedPath& path, const Machine& axes);

}  // namespace bahnwerk
