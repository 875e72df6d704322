#pragma once
/// The factor by which a law exceeds the limits of the axes and along the path.
#include "core/base/progress_scope.hpp"
#include "core/machine/limits.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Returns the factor by which the law has to last longer for all limits to hold: velocities are divided by it,
/// accelerations by its square, jerks by its cube. It is below 1 where the limits are not used in full. The limited
/// quantities are the axes' velocity q′v, acceleration q″v² + q′a and jerk q‴v³ + 3q″va + q′j; v, a and j along the
/// path; the feeds; and at joints at which the motion does not rest the steps |Δq′| v against acceleration · cycle time
/// and |Δ(q″v² + q′a)| against jerk · cycle time.
///
/// Peaks are continuous: they are found by adaptive interpolation (core/numeric/peak.hpp) to 1e-7 of their value with
/// an estimated error. Proving the limits is left to the verifier. Cost: about 15 evaluations of the axes per piece of
/// the law, more where they change quickly. Returns 0 for an empty law.
double law_excess(const PathTask& task, const TimeLaw& law, const Limits& along, ProgressScope& progress);

}  // namespace bahnwerk
