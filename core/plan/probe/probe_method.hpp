#pragma once
/// The methods of kind `probe_path`, and the bound with which they are compared.
#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/plan/probe/probe_plan.hpp"

namespace bahnwerk {

/// Returns the motion of the request's method.
ProbeMotion probe_motion(const ProbeRequest& request, Progress progress);

/// Returns the proven bound on the duration; its cost is limited to some seconds for methods other than optimal.
Bound probe_bound_of(const ProbeRequest& request, Progress progress);

}  // namespace bahnwerk
