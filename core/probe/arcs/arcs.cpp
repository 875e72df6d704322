#include "core/probe/arcs/arcs.hpp"

#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/arcs/speed_choice.hpp"
#include "core/probe/arcs/turn_path.hpp"
#include "core/probe/lasting_phases.hpp"
#include "core/probe/reachable_speed.hpp"
#include "core/probe/rest_sections.hpp"
#include "core/probe/straight/rows.hpp"
#include "core/probe/straight/stops.hpp"

namespace bahnwerk {
namespace {

using namespace probe;

/// Directions per edge of the problem from those between nodes.
std::vector<Vec> spread(const ProbeProblem& problem, const TurnPath& path) {
  std::vector<Vec> directions(problem.edges());
  const std::vector<std::size_t>& node = path.speeds().node;
  for (std::size_t i = 0; i + 1 < node.size(); ++i)
    for (std::size_t edge = node[i]; edge < node[i + 1]; ++edge) directions[edge] = path.direction(i);
  return directions;
}

/// Chooses speeds for directions and solves directions for speeds, in turn, nearer and nearer to the quickest path that
/// was found.
TurnPath quickest_turns(const ProbeProblem& problem, const std::vector<std::size_t>& row_end, ProgressScope& scope) {
  constexpr std::size_t many = 100;  // points, above which fewer rounds have to do
  constexpr double least_width = 1e-3, worth_while = 1e-4;
  const int rounds = problem.points.size() > many ? 3 : 12;
  std::vector<Vec> directions;
  for (std::size_t i = 0; i < problem.edges(); ++i) {
    const Vec edge = problem.points[i + 1] - problem.points[i];
    directions.push_back(edge / norm(edge));
  }
  const auto path_for = [&](const TurnSpeeds* near, double width) {
    TurnPath path(problem, choose_speeds(problem, row_end, directions, near, width, scope));
    path.solve(1e-15, scope);
    path.repair(scope);
    return path;
  };
  TurnPath best = path_for(nullptr, 0);
  double width = 0.2;
  for (int round = 1; round < rounds && width > least_width; ++round) {
    directions = spread(problem, best);
    TurnPath path = path_for(&best.speeds(), width);
    const double before = best.duration(), now = path.duration();
    if (now < before) best = std::move(path);
    if (!(now < before * (1 - worth_while))) width /= 3;
  }
  return best;
}

/// Returns the quickest sections of straights with turns, and of rests at the ends of rows.
ProbeMotion straights_with_turns(const ProbeProblem& given, ProgressScope& scope) {
  const ProbeProblem problem = with_reachable_speed(given);
  const std::vector<std::size_t> row_end = straight_rows(problem);
  std::vector<ProbeMotion> plans{write_stops(problem, row_end, scope)};
  if (row_end[0] + 1 == problem.points.size()) return plans.front();
  plans.push_back(quickest_turns(problem, row_end, scope).write(scope));
  return quickest_sections(problem, std::move(plans));
}

}  // namespace

ProbeMotion plan_arcs(const ProbeProblem& problem, Progress progress) {
  ProgressScope scope(progress, "arcs");
  scope.report();
  return with_lasting_phases(
      problem, straights_with_turns(problem, scope),
      [&](const ProbeProblem& eased) { return straights_with_turns(eased, scope); }, scope);
}

}  // namespace bahnwerk
