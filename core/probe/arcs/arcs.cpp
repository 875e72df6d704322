#include "core/probe/arcs/arcs.hpp"

#include <algorithm>
#include <optional>
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

TurnSpeeds all_rests(const ProbeProblem& problem, const std::vector<std::size_t>& row_end) {
  TurnSpeeds rests;
  for (std::size_t i = 0;; i = row_end[i]) {
    rests.node.push_back(i);
    rests.speed.push_back(0);
    if (i + 1 == problem.points.size()) return rests;
  }
}

constexpr std::size_t many = 100;  // points from which on fewer speeds are compared

/// Candidates of one round of the search: shares of what the tube admits, factors of the speed found before.
struct Round {
  std::vector<double> shares, factors;
};
const std::vector<Round>& rounds_for(std::size_t points) {
  static const auto ladder = [](double ratio) {
    std::vector<double> shares{1};
    while (shares.back() > 0.02) shares.push_back(ratio * shares.back());
    return shares;
  };
  static const std::vector<Round> thorough{{ladder(0.88), {}},
                                           {{1, 0.6, 0.3}, {0.75, 0.87, 0.93, 1.07, 1.15, 1.33}},
                                           {{1, 0.5}, {0.93, 0.97, 1.03, 1.07}},
                                           {{1}, {0.98, 0.99, 1.01, 1.02}},
                                           {{}, {0.995, 0.998, 1.002, 1.005}}};
  static const std::vector<Round> quick{{ladder(0.75), {}}, {{0.5}, {0.8, 0.92, 1.1, 1.3}}, {{}, {0.96, 1.04}}};
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

/// Straights and turns for one problem: the quickest path that is found. Refers to the problem.
class ArcSearch {
 public:
  /// `row_end` as straight_rows() has it.
  ArcSearch(const ProbeProblem& problem, const std::vector<std::size_t>& row_end)
      : problem_(problem), choice_(problem, row_end), best_(problem, all_rests(problem, row_end)) {
    shortest_ = best_.duration();
  }

  /// Alternates between speeds and directions; then begins with the quickest path and searches closer and closer about
  /// it, for as long as that helps. Of few points, it begins twice: with the directions of the edges, as if the head
  /// rested, and with those of turns at the largest speeds.
  const TurnPath& search(ProgressScope& scope) {
    const std::vector<Vec> edges = edge_directions(problem_);
    alternate(edges, scope);
    if (problem_.points.size() > many) return best_;
    alternate(turned(edges, scope), scope);
    polish(scope);
    return best_;
  }

 private:
  void alternate(std::vector<Vec> directions, ProgressScope& scope) {
    std::optional<TurnSpeeds> near;
    for (const Round& round : rounds_for(problem_.points.size())) {
      near = choice_.choose(directions, round.shares, near ? &*near : nullptr, round.factors, scope);
      TurnPath path(problem_, *near);
      path.solve(1e-9, scope);
      directions = spread(problem_, path);
      offer(std::move(path), scope);
    }
  }
  std::vector<Vec> turned(const std::vector<Vec>& directions, ProgressScope& scope) const {
    TurnSpeeds all{{}, choice_.largest_speeds(directions)};
    for (std::size_t i = 0; i < all.speed.size(); ++i) all.node.push_back(i);
    TurnPath path(problem_, std::move(all));
    path.solve(1e-9, scope);
    return path.directions();
  }
  void polish(ProgressScope& scope) {
    constexpr int most = 9;
    constexpr double worth_while = 1e-5;
    static const std::vector<double> shares{1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}, none;
    double width = 0.1;
    for (int round = 0; round < most && width > 1e-4; ++round) {
      const double before = shortest_;
      const std::vector<double> factors{1 - 2 * width, 1 - width, 1 - width / 3, 1 + width / 3, 1 + width};
      offer({problem_, choice_.choose(spread(problem_, best_), shares, &best_.speeds(), factors, scope,
                                      round == 0 ? shares : none)},
            scope);
      if (!(shortest_ < before * (1 - worth_while))) width /= 3;
    }
  }
  /// Makes turns and straights fit; the path becomes the best one if it is.
  void offer(TurnPath path, ProgressScope& scope) {
    path.solve(1e-15, scope);
    path.repair(scope);
    if (const double duration = path.duration(); duration < shortest_) shortest_ = duration, best_ = std::move(path);
  }

  const ProbeProblem& problem_;
  SpeedChoice choice_;
  TurnPath best_;
  double shortest_ = 0;
};

/// The quickest sections of the paths through all points, through those that are left of points in a row, and of rests
/// at the ends of rows.
ProbeMotion search_arcs(const ProbeProblem& given, ProgressScope& scope) {
  const ProbeProblem problem = with_reachable_speed(given);
  const std::vector<std::size_t> row_end = straight_rows(problem);
  std::vector<ProbeMotion> plans{write_stops(problem, row_end, scope)};
  if (row_end[0] + 1 == problem.points.size()) return plans.front();
  plans.push_back(ArcSearch(problem, row_end).search(scope).write(scope));
  scope.half_of_rest();
  const ThinnedProblem thin = thinned(problem);
  if (thin.point.size() < problem.points.size())
    plans.push_back(with_all_points(problem, thin, ArcSearch(thin.problem, thin.next).search(scope).write(scope)));
  return quickest_sections(problem, std::move(plans));
}

}  // namespace

ProbeMotion plan_arcs(const ProbeProblem& problem, Progress& progress, double progress_from, double progress_to) {
  ProgressScope scope(progress, "arcs", progress_from, progress_to);
  scope.report();
  return with_lasting_phases(
      problem, search_arcs(problem, scope), [&](const ProbeProblem& eased) { return search_arcs(eased, scope); },
      scope);
}

}  // namespace bahnwerk
