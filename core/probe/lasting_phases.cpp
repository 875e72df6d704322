#include "core/probe/lasting_phases.hpp"

#include <algorithm>
#include <utility>

#include "core/probe/within_limits.hpp"

namespace bahnwerk::probe {
namespace {

constexpr double least_phase = 1e-6;  // relative to the motion's duration: rounding leaves 2e-10 of the phase open
constexpr double kept = 5e-10;        // relative excess that a motion that keeps its limits may seem to have

}  // namespace

ProbeProblem with_phases_of(double phase, ProbeProblem problem) {
  for (AxisLimits& axis : problem.machine.axes) {
    axis.jerk = std::min(axis.jerk, axis.acceleration / phase);
    axis.snap = std::min(axis.snap, axis.jerk / phase);
  }
  return problem;
}

bool phases_may_blur(const ProbeProblem& problem, double duration) {
  constexpr double lasting = 4 * least_phase;
  for (const AxisLimits& axis : problem.machine.axes)
    if (axis.acceleration < lasting * duration * axis.jerk || axis.jerk < lasting * duration * axis.snap) return true;
  return false;
}

ProbeMotion with_lasting_phases(const ProbeProblem& problem, ProbeMotion plan,
                                const std::function<ProbeMotion(const ProbeProblem&)>& plan_for,
                                ProgressScope& progress) {
  if (!phases_may_blur(problem, plan.duration())) return plan;
  ProbeMotion slower = within_limits(problem, plan, progress);
  if (slower.duration() <= plan.duration()) return plan;
  ProbeMotion again =
      within_limits(problem, plan_for(with_phases_of(least_phase * plan.duration(), problem)), progress);
  const bool right = needed_slowing(problem, slower, 1, progress) <= 1 + kept;
  return right && slower.duration() <= again.duration() ? slower : again;
}

}  // namespace bahnwerk::probe
