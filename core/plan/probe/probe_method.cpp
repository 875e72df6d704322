#include "core/plan/probe/probe_method.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "core/base/progress_part.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/optimal/optimal.hpp"
#include "core/probe/rest_sections.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/verify/probe/probe_bound.hpp"

namespace bahnwerk {
namespace {

ProbeMotion optimal(const ProbeProblem& problem, Progress& progress) {
  std::vector<ProbeMotion> starts{plan_arcs(problem, progress, 0, 0.1)};
  starts.push_back(plan_spline(problem, progress, 0.1, 0.2));
  ProgressPart part(progress, "optimal", 0.2, 0.7);
  return plan_optimal(problem, starts, part);
}

/// A spline where it is quicker than straights with turns, which it is not where edges are long beside the tube.
ProbeMotion spline_or_turns(const ProbeProblem& problem, Progress& progress) {
  std::vector<ProbeMotion> plans{plan_spline(problem, progress, 0, 0.4)};
  plans.push_back(plan_arcs(problem, progress, 0.4, 0.7));
  return probe::quickest_sections(problem, std::move(plans));
}

struct ProbeMethodRow {
  ProbeMethod method;
  ProbeMotion (*plan)(const ProbeProblem&, Progress&);
};
constexpr ProbeMethodRow rows[] = {
    {ProbeMethod::optimal, optimal},
    {ProbeMethod::arcs, [](const ProbeProblem& p, Progress& progress) { return plan_arcs(p, progress, 0, 0.7); }},
    {ProbeMethod::spline, spline_or_turns},
};

}  // namespace

ProbeMotion probe_motion(const ProbeRequest& request, Progress& progress) {
  for (const ProbeMethodRow& row : rows)
    if (row.method == request.method) return row.plan(request.problem, progress);
  throw std::logic_error("a method of probe paths without a row");
}

Bound probe_bound_of(const ProbeRequest& request, Progress& progress, double from, double to) {
  ProgressPart part(progress, "bound", from, to);
  // A bound that costs more than the plan is for the method that comes near to it.
  constexpr std::size_t thorough = 1000, quick = 40;
  return probe_bound(request.problem, part, request.method == ProbeMethod::optimal ? thorough : quick);
}

}  // namespace bahnwerk
