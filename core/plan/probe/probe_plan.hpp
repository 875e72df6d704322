#pragma once
/// Plans of kind `probe_path`: a method's motion, whole cycles, verification, bound, setpoints.
#include <memory>

#include "core/base/named.hpp"
#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/motion/setpoints/cycles.hpp"
#include "core/probe/figures.hpp"
#include "core/probe/probe_motion.hpp"
#include "core/probe/problem.hpp"

namespace bahnwerk {

enum class ProbeMethod { optimal, arcs, spline };
inline constexpr Named<ProbeMethod> probe_methods[] = {
    {ProbeMethod::optimal, "optimal"}, {ProbeMethod::arcs, "arcs"}, {ProbeMethod::spline, "spline"}};
inline constexpr Named<ProbeObjective> probe_objectives[] = {{ProbeObjective::time, "time"},
                                                             {ProbeObjective::ripple, "ripple"}};

struct ProbeRequest {
  ProbeProblem problem;
  ProbeMethod method = ProbeMethod::optimal;
  double max_setpoints = 20'000'000;
};

struct ProbePlan {
  std::shared_ptr<const ProbeProblem> problem;
  double duration = 0;  ///< s, as planned
  double stops = 0;     ///< s: duration with rests at every point but for those in a row
  Cycles cycles;
  ProbeMotion motion;    ///< slowed to whole cycles: what is verified and sampled
  ProbeFigures figures;  ///< figures of `motion`
  Verification verification;
  Bound bound;
  std::unique_ptr<SetpointSource> setpoints;
};

/// Plans the request. Throws InvalidInput for a motion of more than max_setpoints setpoints, and what progress throws.
ProbePlan plan_probe(const ProbeRequest& request, Progress progress);

}  // namespace bahnwerk
