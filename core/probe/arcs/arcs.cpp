#include "core/probe/arcs/arcs.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/arcs/speed_choice.hpp"
#include "core/probe/arcs/turn_path.hpp"
#include "core/probe/lasting_phases.hpp"
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
  constexpr std::size_t many = 100;
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
  explicit ArcSearch(const ProbeProblem& problem)
      : problem_(problem),
        row_end_(straight_rows(problem)),
        choice_(problem, row_end_),
        best_(problem, all_rests(problem, row_end_)) {
    shortest_ = best_.duration();
  }

  const TurnPath& best() const { return best_; }
  double duration() const { return shortest_; }
  /// Returns whether all points are in one row, so that there is nothing to choose.
  bool single() const { return best_.nodes() == 2; }

  /// Alternates between speeds and directions, from the edges' directions on.
  void search(ProgressScope& scope) {
    std::vector<Vec> directions = edge_directions(problem_);
    std::optional<TurnSpeeds> near;
    const std::vector<Round>& rounds = rounds_for(problem_.points.size());
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      near = choice_.choose(directions, rounds[k].shares, near ? &*near : nullptr, rounds[k].factors, scope);
      TurnPath path(problem_, *near);
      path.solve(k + 1 < rounds.size() ? 1e-9 : 1e-15, scope);
      directions = spread(problem_, path);
      offer(std::move(path), scope);
    }
  }
  /// Begins with the quickest path and searches closer and closer about it, for as long as that helps.
  void polish(ProgressScope& scope) { polish(best_, shortest_, scope); }
  /// Begins with speeds and directions of a path that keeps more than this problem asks for.
  void adopt(const TurnPath& other, ProgressScope& scope) {
    constexpr double promising = 1.003;
    const double known = shortest_;
    TurnPath path(problem_, other.speeds());
    path.start_from(other.directions());
    path = offer(std::move(path), scope);
    const double duration = path.duration();
    // A search that ends where another one has ended before finds that path again.
    if (duration != known && duration < promising * shortest_) polish(std::move(path), duration, scope);
  }

 private:
  void polish(TurnPath path, double duration, ProgressScope& scope) {
    constexpr int most = 9;
    constexpr double worth_while = 1e-5;
    static const std::vector<double> shares{1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}, none;
    double width = 0.1;
    for (int round = 0; round < most && width > 1e-4; ++round) {
      const TurnSpeeds near = path.speeds();
      const std::vector<double> factors{1 - 2 * width, 1 - width, 1 - width / 3, 1 + width / 3, 1 + width};
      TurnPath next = offer(
          {problem_, choice_.choose(spread(problem_, path), shares, &near, factors, scope, round == 0 ? shares : none)},
          scope);
      const double before = duration;
      if (const double now = next.duration(); now < duration) path = std::move(next), duration = now;
      if (!(duration < before * (1 - worth_while))) width /= 3;
    }
  }
  /// The path with turns and straights that fit; it becomes the best one if it is.
  TurnPath offer(TurnPath path, ProgressScope& scope) {
    path.solve(1e-15, scope);
    path.repair(scope);
    path.prefer_rests(row_end_);
    if (const double duration = path.duration(); duration < shortest_) shortest_ = duration, best_ = path;
    return path;
  }

  const ProbeProblem& problem_;
  std::vector<std::size_t> row_end_;
  SpeedChoice choice_;
  TurnPath best_;
  double shortest_ = 0;
};

/// The quickest path that is found for the problem and for tighter ones. Progress covers the scope's part [begin, 1].
ProbeMotion search_arcs(const ProbeProblem& problem, double begin, ProgressScope& scope) {
  const ProbeProblem reachable = with_reachable_speed(problem);
  ArcSearch search(reachable);
  if (search.single()) return search.best().write(scope);
  // Each further problem costs as much as the first one, which is seconds for some hundred points.
  constexpr std::size_t many = 100;
  constexpr double first = 0.1;  // share of the progress at which further problems begin
  const auto part = [&](double from, double to) { scope.part(begin + (1 - begin) * from, begin + (1 - begin) * to); };
  const bool further = problem.points.size() <= many;
  part(0, further ? first : 1);
  search.search(scope);
  if (!further) return search.best().write(scope);
  search.polish(scope);
  std::vector<ProbeProblem> problems = slower_problems(reachable, search.duration());
  for (ProbeProblem& weaker : weaker_problems(reachable)) problems.push_back(std::move(weaker));
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const auto n = static_cast<double>(problems.size()), at = static_cast<double>(i);
    part(first + (1 - first) * at / n, first + (1 - first) * (at + 1) / n);
    ArcSearch tighter(problems[i]);
    tighter.search(scope);
    search.adopt(tighter.best(), scope);
  }
  return search.best().write(scope);
}

}  // namespace

ProbeMotion plan_arcs(const ProbeProblem& problem, Progress& progress, double progress_from, double progress_to) {
  ProgressScope scope(progress, "arcs", progress_from, progress_to);
  scope.report();
  return with_lasting_phases(
      problem, search_arcs(problem, 0, scope), [&](const ProbeProblem& eased) { return search_arcs(eased, 1, scope); },
      scope);
}

}  // namespace bahnwerk
