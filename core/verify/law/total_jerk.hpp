#pragma once
/// The jerk of the tool in space; the jerk along the path is one of its components [Herrmann (4.80)].
#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {

/// Returns the largest ‖h‴v³ + 3h″va + h′j‖ of a law along a path, mm/s³, and its time, s: an enclosure to 1e-7 of
/// itself, like the peaks of axes (core/verify/law/axis_peaks.hpp), with their exception next to a vanishing tangent.
/// About 1 µs per piece of the law.
Worst total_jerk(const Path& tool, const TimeLaw& law, ProgressScope& progress);

}  // namespace bahnwerk::verify
