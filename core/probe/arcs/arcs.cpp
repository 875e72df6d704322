#include "core/probe/arcs/arcs.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/arcs/speed_choice.hpp"
#include "core/probe/arcs/turn_path.hpp"
#include "core/probe/straight/straight.hpp"
#include "core/probe/tighter.hpp"

namespace bahnwerk {
namespace {

using namespace probe;

TurnSpeeds all_rests(const ProbeProblem& problem, const std::vector<std::size_t>& row_end) {
  TurnSpeeds rests;
  for (std::size_t i = 0;; i = row_end[i]) {
    rests.node.push_back(i);
    rests.speed.push_back(0);
    if (i + 1 == problem.points.size()) return rests;
  }
}

/// Candidates of one round of the search: shares of what the tube admits, factors of the speed found before.
struct Round {
  std::vector<double> shares, factors;
};
const std::vector<Round>& rounds_for(std::size_t points) {
  static const std::vector<Round> thorough{{{1, 0.85, 0.7, 0.55, 0.42, 0.3, 0.2, 0.1}, {}},
                                           {{1, 0.6, 0.3}, {0.7, 0.84, 0.92, 1.08, 1.18, 1.4}},
                                           {{1, 0.5}, {0.93, 0.97, 1.03, 1.07}},
                                           {{1}, {0.98, 0.99, 1.01, 1.02}},
                                           {{}, {0.995, 0.998, 1.002, 1.005}}};
  static const std::vector<Round> quick{
      {{1, 0.75, 0.55, 0.4, 0.25, 0.1}, {}}, {{0.5}, {0.8, 0.92, 1.1, 1.3}}, {{}, {0.96, 1.04}}};
  constexpr std::size_t many = 2000;
  return points > many ? quick : thorough;
}

/// Directions per edge of the problem from those between nodes.
std::vector<Vec> spread(const ProbeProblem& problem, const TurnPath& path) {
  std::vector<Vec> directions(problem.edges());
  const auto& node = path.speeds().node;
  for (std::size_t i = 0; i + 1 < node.size(); ++i)
    for (std::size_t edge = node[i]; edge < node[i + 1]; ++edge) directions[edge] = path.direction(i);
  return directions;
}

std::vector<Vec> edge_directions(const ProbeProblem& problem) {
  std::vector<Vec> directions;
  for (std::size_t i = 0; i < problem.edges(); ++i) {
    const Vec edge = problem.points[i + 1] - problem.points[i];
    directions.push_back(edge / norm(edge));
  }
  return directions;
}

/// Straights and turns for the problem as it is. Refers to it.
TurnPath quickest_path(const ProbeProblem& problem, ProgressScope& scope) {
  const std::vector<std::size_t> row_end = straight_rows(problem);
  std::optional<TurnPath> best;
  best.emplace(problem, all_rests(problem, row_end));
  if (best->nodes() == 2) return std::move(*best);
  double shortest = best->duration();
  const SpeedChoice choice(problem, row_end);
  std::vector<Vec> directions = edge_directions(problem);
  std::optional<TurnSpeeds> near;
  const std::vector<Round>& rounds = rounds_for(problem.points.size());
  for (std::size_t k = 0; k < rounds.size(); ++k) {
    scope.part(static_cast<double>(k) / static_cast<double>(rounds.size()),
               static_cast<double>(k + 1) / static_cast<double>(rounds.size()));
    near = choice.choose(directions, rounds[k].shares, near ? &*near : nullptr, rounds[k].factors, scope);
    TurnPath path(problem, *near);
    path.solve(k + 1 < rounds.size() ? 1e-9 : 1e-15, scope);
    directions = spread(problem, path);
    path.solve(1e-15, scope);
    path.repair(scope);
    path.prefer_rests(row_end);
    if (const double duration = path.duration(); duration < shortest)
      shortest = duration, best.emplace(std::move(path));
  }
  return std::move(*best);
}

}  // namespace

ProbeMotion plan_stops(const ProbeProblem& problem, Progress& progress) {
  ProgressScope scope(progress, "stops", 0, 1);
  return TurnPath(problem, all_rests(problem, straight_rows(problem))).write(scope);
}

double stops_duration(const ProbeProblem& problem) {
  return TurnPath(problem, all_rests(problem, straight_rows(problem))).duration();
}

ProbeMotion plan_arcs(const ProbeProblem& problem, Progress& progress, double progress_from, double progress_to) {
  ProgressScope scope(progress, "arcs", progress_from, progress_to);
  scope.report();
  // Speeds that cannot be reached are one problem.
  ProbeProblem reachable = problem;
  reachable.speed = std::min(problem.speed, unreachable_speed(problem));
  return quickest_path(reachable, scope).write(scope);
}

}  // namespace bahnwerk
