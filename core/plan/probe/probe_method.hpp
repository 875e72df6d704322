#pragma once
/// The methods of kind `probe_path`, one row each, and the bound that all are held to.
#include "core/base/verification.hpp"
#include "core/plan/probe/probe_plan.hpp"

namespace bahnwerk {

class Progress;

/// The motion of the request's method. Reports progress up to 0.7.
ProbeMotion probe_motion(const ProbeRequest& request, Progress& progress);

/// The proven bound on the duration, with its gap to `duration`: for more than 1000 points and methods other than
/// optimal only that of edges at full speed. Reports progress from 0.7 to 0.8.
Bound probe_bound_of(const ProbeRequest& request, double duration, Progress& progress);
/// That a duration is not below its bound, as a check.
Check probe_bound_check(const Bound& bound, double duration);

}  // namespace bahnwerk
