#include "core/geometry/spline/search/best_link.hpp"

#include <algorithm>
#include <array>

#include "core/geometry/spline/search/link_variables.hpp"

namespace bahnwerk {
namespace {

constexpr double uniqueness = 1e-2;

}  // namespace

BestLink best_link(const SmoothnessRule& rule, const LinkEnds& ends, const BestLinkOptions& options,
                   Progress progress) {
  const SmoothnessWeights& weights = options.weights;
  const std::optional<LinkShape>& start = options.start;
  const LinkVariables variables(rule.continuity(), ends);
  const LinkEnds& scaled = variables.ends();
  const double chord = variables.chord();
  const bool distance = options.objective == LinkObjective::control_distance;

  const std::vector<double> first = start ? variables.of(*start) : variables.straight();
  const std::vector<double> held = start ? start->weights : std::vector<double>();
  // Value and gradient of either measure by γ.
  const auto measured = [&](bool by_distance, std::span<const double> x, std::span<double> gradient) {
    std::array<double, 2 * (spline_orders - 1)> room{};
    const std::span<double> by_beta = std::span(room).first(gradient.size());
    LinkShape shape = variables.scaled(x);
    shape.weights = held;
    const double f = by_distance ? control_distance(rule.continuity(), scaled, shape, by_beta)
                                 : smoothness(rule, scaled, shape, weights, by_beta);
    if (!gradient.empty()) variables.pull_back(x, by_beta, gradient);
    return f;
  };

  OptimisationProblem problem;
  problem.dimension = variables.size();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::size_t j = variables.order(i);
    problem.lower.push_back(LinkVariables::lower(j));
    problem.upper.push_back(LinkVariables::upper(j));
    problem.scale.push_back(LinkVariables::scale(j));
  }
  const double at_start = std::max(measured(false, first, {}), 1e-9);
  problem.objective_scale = distance ? chord : at_start;
  problem.objective = [&](std::span<const double> x, std::span<double> gradient) {
    double f = measured(distance, x, gradient);
    if (distance) {
      const double share = uniqueness * chord / at_start;
      std::array<double, 2 * (spline_orders - 1)> room{};
      const std::span<double> more = std::span(room).first(gradient.size());
      f += share * measured(false, x, more);
      for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] += share * more[i];
    }
    return f;
  };
  OptimisationOptions search;
  search.max_evaluations = options.max_evaluations;
  const auto result = minimise(problem, first, search, progress);

  BestLink best;
  const bool better = !result.x.empty() && result.objective <= problem.objective(first, {});
  const std::vector<double>& x = better ? result.x : first;
  best.shape = variables.own(x);
  best.shape.weights = held;
  best.objective = measured(distance, x, {});
  LinkShape shape = variables.scaled(x);
  shape.weights = held;
  best.smoothness = smoothness(rule, scaled, shape, weights);
  best.evaluations = result.evaluations;
  return best;
}

}  // namespace bahnwerk
