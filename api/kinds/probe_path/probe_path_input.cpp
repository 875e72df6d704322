// The spec of kind "probe_path" → points, limits, options.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "api/kinds/probe_path/probe_path.hpp"
#include "core/base/errors.hpp"

namespace bahnwerk::api::probe_path {
namespace {

using nlohmann::json;

constexpr const char* axis_names[] = {"x", "y", "z"};

void read_points(const json& list, std::size_t dimension, ProbeProblem& problem, std::vector<InputFault>& faults) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].size() != dimension) {
      faults.push_back({{"points", std::to_string(i)},
                        "has " + std::to_string(list[i].size()) + " coordinates, the first point has " +
                            std::to_string(dimension) + ": give all points 2 or all points 3"});
      continue;
    }
    Vec p;
    for (std::size_t k = 0; k < dimension; ++k) p[k] = list[i][k].get<double>() + 0.0;  // no −0
    problem.given.push_back(p);
  }
}

void read_limits(const json& limits, std::size_t dimension, ProbeProblem& problem, std::vector<InputFault>& faults) {
  for (std::size_t k = 0; k < dimension; ++k) {
    if (!limits.contains(axis_names[k])) {
      faults.push_back({{"limits", axis_names[k]}, "is missing: the points have three coordinates"});
      continue;
    }
    const json& of = limits[axis_names[k]];
    AxisLimits axis(axis_names[k], unlimited, of["acceleration"].get<double>(), of["jerk"].get<double>());
    axis.snap = of["snap"].get<double>();
    problem.machine.axes.push_back(std::move(axis));
  }
}

}  // namespace

ProbeRequest request(const json& spec) {
  ProbeRequest request;
  ProbeProblem& problem = request.problem;
  std::vector<InputFault> faults;
  const std::size_t dimension = spec["points"][0].size();
  read_points(spec["points"], dimension, problem, faults);
  read_limits(spec["limits"], dimension, problem, faults);
  problem.tolerance = spec["tolerance"].get<double>();
  problem.speed = spec["speed"].get<double>();
  problem.point_tolerance = spec.value("point_tolerance", problem.point_tolerance);
  problem.machine.cycle_time = spec.value("cycle_time", problem.machine.cycle_time);
  problem.objective = value_of<ProbeObjective>(spec.value("objective", "time"), probe_objectives);
  problem.stretch = spec.value("stretch", problem.stretch);
  request.method = value_of<ProbeMethod>(spec.value("method", "optimal"), probe_methods);
  if (problem.objective == ProbeObjective::ripple && request.method != ProbeMethod::optimal)
    faults.push_back({{"objective"}, "ripple is an objective of method optimal: take that, or objective time"});
  if (faults.empty()) {
    try {
      merge_points(problem);
    } catch (const InvalidInput& error) {
      faults = error.faults;
    }
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return request;
}

std::vector<std::string> notes(const json& spec) {
  std::vector<std::string> list;
  if (spec["points"][0].size() == 2 && spec["limits"].contains("z"))
    list.emplace_back("limits.z is not used: the points have two coordinates");
  if (spec.contains("stretch") && spec.value("objective", "time") == "time")
    list.emplace_back("stretch is not used: it belongs to objective ripple");
  return list;
}

}  // namespace bahnwerk::api::probe_path
