#pragma once
/// Checks that a motion rests where its contour requires it, and for as long.
#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Returns the check of the rests. It matches the times at which the law is at rest, in order, with the places of
/// `given.rests`: the path driven has to be within `position_tolerance` (mm) of the place, and the law at rest there
/// for the sum of the seconds. `value`, s, is the largest deficit of a rest, infinite where the motion does not rest at
/// all; `limit` is 16 ε of the law's duration, the rounding of adding and slowing dwells; `at` is the time of that
/// rest, s. The check's name is "dwell". O(pieces + rests). Passes exceptions of `progress` on.
Check rest_check(const Contour& given, const Contour& driven, const TimeLaw& law, Progress progress,
                 double position_tolerance = 1e-6);

}  // namespace bahnwerk
