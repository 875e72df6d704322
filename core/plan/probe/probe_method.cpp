#include "core/plan/probe/probe_method.hpp"

#include <stdexcept>

#include "core/probe/arcs/arcs.hpp"
#include "core/probe/optimal/optimal.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/verify/probe/probe_bound.hpp"

namespace bahnwerk {
namespace {

struct ProbeMethodRow {
  ProbeMethod method;
  ProbeMotion (*plan)(const ProbeProblem&, Progress);
};
constexpr ProbeMethodRow rows[] = {
    {ProbeMethod::optimal, plan_optimal},
    {ProbeMethod::arcs, plan_arcs},
    {ProbeMethod::spline, plan_spline},
};

}  // namespace

ProbeMotion probe_motion(const ProbeRequest& request, Progress progress) {
  for (const ProbeMethodRow& row : rows)
    if (row.method == request.method) return row.plan(request.problem, progress);
  throw std::logic_error("a method of probe paths without a row");
}

Bound probe_bound_of(const ProbeRequest& request, Progress progress) {
  // A bound that costs more than the plan is for the method that comes near to it.
  constexpr std::size_t thorough = 1000, quick = 40;
  return probe_bound(request.problem, progress, request.method == ProbeMethod::optimal ? thorough : quick);
}

}  // namespace bahnwerk
