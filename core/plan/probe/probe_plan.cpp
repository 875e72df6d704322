#include "core/plan/probe/probe_plan.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/plan/probe/probe_method.hpp"
#include "core/plan/probe/probe_setpoints.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/resting_motion.hpp"
#include "core/verify/probe/probe_setpoint_checks.hpp"

namespace bahnwerk {
namespace {

void limit_rows(double duration, double cycle_time, double most) {
  const double count = std::ceil(duration / cycle_time) + 1;
  if (count <= most) return;
  char text[120];
  std::snprintf(text, sizeof text, "the motion has %.0f setpoints, at most %.0f are allowed", count, most);
  throw InvalidInput(std::vector<InputFault>{{{"cycle_time"}, text}});
}

}  // namespace

ProbePlan plan_probe(const ProbeRequest& request, Progress& progress) {
  constexpr double bounded = 0.8, verified = 0.9;
  ProbePlan plan;
  plan.problem = std::make_shared<const ProbeProblem>(request.problem);
  const ProbeProblem& problem = *plan.problem;
  const ProbeMotion planned = probe_motion(request, progress);
  plan.duration = planned.duration();
  plan.stops = stops_duration(problem);
  const double cycle = problem.machine.cycle_time;
  limit_rows(plan.duration, cycle, request.max_setpoints);
  ProgressScope scope(progress, "figures", 0.7, 0.7);
  plan.cycles = whole_cycles(plan.duration, cycle);
  plan.motion = slowed(planned, plan.cycles.factor, static_cast<double>(plan.cycles.count) * cycle, &scope);
  plan.figures = probe_figures(problem, plan.motion, scope);
  plan.bound = probe_bound_of(request, plan.duration, progress);
  plan.setpoints = std::make_unique<ProbeSetpoints>(plan.problem, plan.motion, plan.cycles.count);

  const RestingMotion motion(plan.motion.motion, problem.points.back());
  ProbeToVerify input{problem, motion, plan.motion.times, bounded, verified};
  plan.verification.passed = true;
  for (Check& check : probe_checks(input, progress)) plan.verification.add(std::move(check));
  input.progress_from = verified;
  input.progress_to = 1;
  for (Check& check : probe_setpoint_checks(input, *plan.setpoints, progress)) plan.verification.add(std::move(check));
  plan.verification.add(probe_bound_check(plan.bound, plan.duration));
  return plan;
}

}  // namespace bahnwerk
