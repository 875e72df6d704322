#pragma once
/// Whether a motion rests where its contour asks for it, and as long.
#include "core/base/verification.hpp"
#include "core/contour/contour.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

/// Walks through the moments at which the law is at rest and matches them, in order, with the places of `given.rests`:
/// the path driven has to be within `position_tolerance` (mm) of the place, and the law to stand there for the sum of
/// the seconds. `value`, s: by how much the worst rest is too short, infinite where the motion does not rest at all;
/// `limit`: 16 ε of the law's duration, what adding and slowing dwells may round. `at`: that rest, s. Name "dwell".
/// Reads geometry, rests and law alone. O(pieces + rests). Progress stays at the fraction `progress_at`; throws what it
/// throws.
Check rest_check(const Contour& given, const Contour& driven, const TimeLaw& law, Progress& progress,
                 double progress_at = 1, double position_tolerance = 1e-6);

}  // namespace bahnwerk
