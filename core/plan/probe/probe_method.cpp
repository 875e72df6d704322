#include "core/plan/probe/probe_method.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/base/progress_part.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/optimal/optimal.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/probe/probe_bound.hpp"

namespace bahnwerk {
namespace {

ProbeMotion optimal(const ProbeProblem& problem, Progress& progress) {
  const ProbeMotion arcs = plan_arcs(problem, progress, 0, 0.1), spline = plan_spline(problem, progress, 0.1, 0.2);
  ProgressPart part(progress, "optimal", 0.2, 0.7);
  const ProbeMotion& start = arcs.duration() <= spline.duration() ? arcs : spline;
  return plan_optimal(problem, start, part);
}

struct ProbeMethodRow {
  ProbeMethod method;
  ProbeMotion (*plan)(const ProbeProblem&, Progress&);
};
constexpr ProbeMethodRow rows[] = {
    {ProbeMethod::optimal, optimal},
    {ProbeMethod::arcs, [](const ProbeProblem& p, Progress& progress) { return plan_arcs(p, progress, 0, 0.7); }},
    {ProbeMethod::spline, [](const ProbeProblem& p, Progress& progress) { return plan_spline(p, progress, 0, 0.7); }},
};

/// From point to point no motion is quicker than straight at full speed.
Bound bound_at_full_speed(const ProbeProblem& problem) {
  double length = 0;
  for (std::size_t i = 0; i < problem.edges(); ++i)
    length += std::max(0.0, norm(problem.points[i + 1] - problem.points[i]) - 2 * problem.point_tolerance);
  Bound bound;
  bound.value = length / problem.speed * (1 - 1e-12);
  bound.basis = "edges at full speed";
  return bound;
}

}  // namespace

ProbeMotion probe_motion(const ProbeRequest& request, Progress& progress) {
  for (const ProbeMethodRow& row : rows)
    if (row.method == request.method) return row.plan(request.problem, progress);
  throw std::logic_error("a method of probe paths without a row");
}

Bound probe_bound_of(const ProbeRequest& request, double duration, Progress& progress) {
  ProgressPart part(progress, "bound", 0.7, 0.8);
  // A bound that costs more than the plan is for the method that comes near to it.
  constexpr std::size_t many = 1000;
  const ProbeProblem& problem = request.problem;
  const bool quick = request.method != ProbeMethod::optimal && problem.points.size() > many;
  return with_gap(quick ? bound_at_full_speed(problem) : probe_bound(problem, part), duration);
}

Check probe_bound_check(const Bound& bound, double duration) { return bound_check(bound, duration); }

}  // namespace bahnwerk
