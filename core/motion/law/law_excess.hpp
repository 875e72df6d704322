#pragma once
/// By how much a law exceeds the limits of the axes and along the path, wherever on its pieces that is.
#include "core/base/progress_scope.hpp"
#include "core/machine/limits.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The factor by which the law has to last longer for all limits to hold: velocities fall with it, accelerations with
/// its square, jerks with its cube; below 1 where there is room. Counted are the axes' velocity q′v, acceleration
/// q″v² + q′a and jerk q‴v³ + 3q″va + q′j; v, a and j along the path, the feeds; and at joints of the path at which
/// the motion does not rest the steps |Δq′| v against acceleration · cycle time, |Δ(q″v² + q′a)| against jerk · cycle
/// time.
///
/// Peaks are continuous ones, between samples, too: found by adaptive interpolation (core/numeric/peak.hpp) to 1e-7 of
/// themselves, with an estimate of what it misses: no proof, which is the verifier's. About 15 evaluations of the axes
/// per piece of the law, more where they change quickly. 0 for an empty law.
double law_excess(const PathTask& task, const TimeLaw& law, const Limits& along, ProgressScope& scope);

}  // namespace bahnwerk
