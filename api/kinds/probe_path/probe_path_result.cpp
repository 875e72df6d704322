// Members of a result of kind "probe_path" beside its figures.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "api/kinds/probe_path/probe_path.hpp"

namespace bahnwerk::api::probe_path {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_listed = 10'000;  // pieces and phases

/// Lists the points of the document; those that count as one have one time.
ordered_json points(const ProbePlan& plan) {
  const ProbeProblem& problem = *plan.problem;
  ordered_json list = ordered_json::array();
  std::size_t piece = 0;
  for (std::size_t i = 0; i < problem.given.size(); ++i) {
    const double t = plan.motion.times[problem.point_of[i]];
    const MotionState x = plan.motion.motion->evaluate(t, piece);
    Vec position;
    for (std::size_t k = 0; k < problem.dimension(); ++k) position[k] = x[0][k];
    list.push_back({{"index", i}, {"time", t}, {"distance", norm(position - problem.given[i])}});
  }
  return list;
}

/// The point of the document that a merged one stands for first.
std::vector<std::size_t> first_given(const ProbeProblem& problem) {
  std::vector<std::size_t> first(problem.points.size(), 0);
  for (std::size_t i = problem.given.size(); i-- > 0;) first[problem.point_of[i]] = i;
  return first;
}

ordered_json phases(const ProbePlan& plan) {
  const std::vector<std::size_t> first = first_given(*plan.problem);
  ordered_json list = ordered_json::array();
  for (const ProbePhase& phase : plan.motion.phases) {
    if (list.size() == most_listed) break;
    list.push_back({{"kind", name_of<ProbePhaseKind>(phase.kind, probe_phase_kinds)},
                    {"start", phase.begin},
                    {"end", phase.end},
                    {"point", first[phase.point]}});
  }
  return list;
}

ordered_json pieces(const ProbePlan& plan) {
  const SplineMotion& motion = *plan.motion.motion;
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < std::min(most_listed, motion.pieces()); ++i) {
    ordered_json axes = ordered_json::array();
    for (std::size_t k = 0; k < motion.axes(); ++k) {
      Polynomial p;
      motion.polynomial(i, k, p);
      axes.push_back(p);
    }
    list.push_back({{"start", motion.begin(i)}, {"end", motion.end(i)}, {"coefficients", std::move(axes)}});
  }
  return list;
}

}  // namespace

std::vector<std::string> notes(const ProbeRequest& request, const ProbePlan& plan) {
  std::size_t rests = 0;
  for (const ProbePhase& phase : plan.motion.phases) {
    if (phase.kind == ProbePhaseKind::turn || phase.kind == ProbePhaseKind::interval) return {};
    rests += phase.kind == ProbePhaseKind::rest ? 1 : 0;
  }
  if (request.method == ProbeMethod::optimal || rests == 0) return {};
  const std::string where = "the head rests at " + std::to_string(rests) +
                            (rests == 1 ? " point, every corner" : " points, every corner") + ": ";
  if (!(request.problem.tolerance > 0)) return {where + "tolerance is 0, so the path has to follow the edges"};
  return {where + "no " + std::string(request.method == ProbeMethod::spline ? "spline" : "turn") +
          " was found that stays within tolerance of the edges and takes less time than a rest"};
}

ordered_json details(const ProbeRequest& request, const std::vector<std::string>& notes, const ProbePlan& plan) {
  return {{"method", name_of<ProbeMethod>(request.method, probe_methods)},
          {"objective", name_of<ProbeObjective>(request.problem.objective, probe_objectives)},
          {"stops_duration", plan.stops},
          {"points", points(plan)},
          {"phases", phases(plan)},
          {"phases_total", plan.motion.phases.size()},
          {"pieces", pieces(plan)},
          {"pieces_total", plan.motion.motion->pieces()},
          {"notes", notes}};
}

}  // namespace bahnwerk::api::probe_path
