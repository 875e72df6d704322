#include "core/probe/arcs/speed_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/bisection.hpp"
#include "core/probe/arcs/turn.hpp"
#include "core/probe/straight/straight.hpp"

namespace bahnwerk::probe {
namespace {
constexpr double length_rounding = 1e-9;  // relative to an edge: margin for the rounding of directions
constexpr int speed_steps = 50;           // steps of the bisection for a speed: to 1e-15 of the interval
constexpr int reach_steps = 40;
// Candidates: speeds of one series, so that neighbours may turn at one speed, which takes no length between, down to a
// share of the largest one.
constexpr double ratio = 0.84, least_share = 0.05;

class SpeedChoice {
 public:
  SpeedChoice(const ProbeProblem& problem, const std::vector<std::size_t>& row_end, const std::vector<Vec>& directions);

  TurnSpeeds choose(const TurnSpeeds* near, double width, ProgressScope& progress) const;

 private:
  struct Candidate {
    double speed = 0;
    TurnSize size;
    Vec offset;           // C − P
    double time = 0;      // shortest from the start to the middle of the turn, s
    int before = -1;      // candidate at the point before
    bool by_row = false;  // whether it comes from a rest at the begin of the row that ends here
  };
  using Candidates = std::vector<Candidate>;
  std::vector<Candidates> candidates(const TurnSpeeds* near, double width) const;
  double largest_speed(std::size_t i) const;
  /// Returns the largest speed per point that the tube admits, that can be reached from the start and braked from.
  std::vector<double> largest_speeds() const;
  /// Returns the speeds, at most `speed`, that can be reached from the start, or braked from to the end.
  std::vector<double> reachable(bool backwards, std::vector<double> speed) const;
  void connect(std::size_t edge, const Candidates& from, Candidates& to) const;
  TurnSpeeds best_path(const std::vector<Candidates>& all) const;

  const ProbeProblem& problem_;
  const std::vector<std::size_t>& row_end_;
  double rounding_;
  const std::vector<Vec>& directions_;  // of the edges
  std::vector<Turn> turns_;             // between them
};

SpeedChoice::SpeedChoice(const ProbeProblem& problem, const std::vector<std::size_t>& row_end,
                         const std::vector<Vec>& directions)
    : problem_(problem), row_end_(row_end), rounding_(coordinate_rounding(problem)), directions_(directions) {
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    turns_.emplace_back(problem, directions[i > 0 ? i - 1 : 0], directions[std::min(i, problem.edges() - 1)]);
}

/// Entry and exit are in the tube, and the turn has room on its edges. Both get harder with the speed.
double SpeedChoice::largest_speed(std::size_t i) const {
  const Turn& turn = turns_[i];
  const Vec before = problem_.points[i - 1], point = problem_.points[i], after = problem_.points[i + 1];
  const Vec in = directions_[i - 1], out = directions_[i];
  const double room = std::min(norm(point - before), norm(after - point));
  const auto fits = [&](double speed) {
    const TurnSize size = turn.size(speed);
    if (size.length > room) return false;
    const Vec apex = turn.apex(point, size);
    return distance_from_edge(apex - size.length * in, before, point) <= problem_.tolerance + rounding_ &&
           distance_from_edge(apex + size.length * out, point, after) <= problem_.tolerance + rounding_;
  };
  if (fits(problem_.speed)) return problem_.speed;
  return bisect(0, problem_.speed, 0, speed_steps, fits).low;
}

std::vector<double> SpeedChoice::reachable(bool backwards, std::vector<double> speed) const {
  const std::size_t n = speed.size();
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const std::size_t i = backwards ? n - 1 - k : k, last = backwards ? i + 1 : i - 1, edge = std::min(i, last);
    const Limits limits = limits_along(problem_, directions_[edge]);
    const double length = norm(problem_.points[edge + 1] - problem_.points[edge]) * (1 - 2 * length_rounding);
    const auto reaches = [&](double v) {
      const double room = length - turns_[i].size(v).length;
      const auto from = [&](double u) {
        const double straight = room - (u > 0 ? turns_[last].size(u).length : 0);
        return straight >= 0 && (v <= u || straight >= min_distance(u, v, limits));
      };
      if (v <= speed[last] && from(v)) return true;
      // A slower turn before leaves more of the edge.
      for (const double share : {1.0, 0.8, 0.6, 0.4, 0.0})
        if (share * speed[last] < v && from(share * speed[last])) return true;
      return false;
    };
    if (!reaches(speed[i])) speed[i] = bisect(0, speed[i], 0, reach_steps, reaches).low;
  }
  return speed;
}

std::vector<double> SpeedChoice::largest_speeds() const {
  std::vector<double> speed(problem_.points.size(), 0.0);
  for (std::size_t i = 1; i + 1 < speed.size(); ++i) speed[i] = largest_speed(i);
  const std::vector<double> reached = reachable(false, speed), braked = reachable(true, speed);
  for (std::size_t i = 0; i < speed.size(); ++i) speed[i] = std::min(reached[i], braked[i]);
  return speed;
}

void SpeedChoice::connect(std::size_t edge, const Candidates& from, Candidates& to) const {
  const Vec chord = problem_.points[edge + 1] - problem_.points[edge];
  const Limits limits = limits_along(problem_, directions_[edge]);
  for (Candidate& next : to) {
    next.time = unlimited;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const Candidate& last = from[k];
      if (!(last.time < unlimited)) continue;
      const double way = norm(chord + (next.offset - last.offset)),
                   turns = last.size.duration / 2 + next.size.duration / 2;
      const double length = way * (1 - length_rounding) - last.size.length - next.size.length;
      if (!(length >= 0) || last.time + turns + length / problem_.speed >= next.time) continue;
      if (length < min_distance(last.speed, next.speed, limits)) continue;
      const double time = last.time + turns + straight_profile(length, last.speed, next.speed, limits).duration;
      if (!(time < next.time)) continue;
      next.time = time, next.before = static_cast<int>(k), next.by_row = false;
    }
  }
}

std::vector<SpeedChoice::Candidates> SpeedChoice::candidates(const TurnSpeeds* near, double width) const {
  const std::size_t n = problem_.points.size();
  const std::vector<double> largest = largest_speeds();
  const double top = *std::max_element(largest.begin(), largest.end());
  std::vector<double> before(n, 0);
  if (near)
    for (std::size_t i = 0; i < near->node.size(); ++i) before[near->node[i]] = near->speed[i];
  std::vector<Candidates> all(n, Candidates(1));  // the first candidate is a rest
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const auto add = [&](double speed) {
      Candidate c;
      c.speed = std::min(speed, largest[i]);
      if (!(c.speed > 0)) return;
      for (const Candidate& other : all[i])
        if (std::abs(other.speed - c.speed) <= 1e-9 * problem_.speed) return;
      c.size = turns_[i].size(c.speed);
      c.offset = turns_[i].apex({}, c.size);
      all[i].push_back(c);
    };
    if (before[i] > 0) {
      for (const double step : {0.0, -2.0, -1.0, -1.0 / 3, 1.0 / 3, 1.0}) add((1 + step * width) * before[i]);
      for (const double speed : {largest[i], before[i - 1], before[i + 1]}) add(speed);
    } else {
      add(largest[i]);
      for (double speed = top; largest[i] > 0 && speed > least_share * largest[i]; speed *= ratio)
        if (speed < largest[i]) add(speed);
    }
  }
  return all;
}

TurnSpeeds SpeedChoice::choose(const TurnSpeeds* near, double width, ProgressScope& progress) const {
  const std::size_t n = problem_.points.size();
  std::vector<Candidates> all = candidates(near, width);
  progress.work(10 * n);
  std::size_t row_begin = 0;
  for (std::size_t i = 1; i < n; ++i) {
    Candidates& here = all[i];
    connect(i - 1, all[i - 1], here);
    if (row_end_[row_begin] == i) {
      if (i - row_begin > 1 && all[row_begin][0].time < unlimited) {
        const double time = all[row_begin][0].time + rest_to_rest_duration(problem_, row_begin, i);
        if (time <= here[0].time) here[0].time = time, here[0].by_row = true;
      }
      row_begin = i;
    }
    progress.work(here.size() * all[i - 1].size());
  }
  return best_path(all);
}

TurnSpeeds SpeedChoice::best_path(const std::vector<Candidates>& all) const {
  const std::size_t n = all.size();
  TurnSpeeds best;
  std::size_t candidate = 0;
  std::vector<std::size_t> begin_of_row(n, 0);
  for (std::size_t i = 0; i < n;) {
    const std::size_t end = std::max(row_end_[i], i + 1);
    for (std::size_t k = i + 1; k <= std::min(end, n - 1); ++k) begin_of_row[k] = i;
    i = end;
  }
  for (std::size_t i = n - 1;;) {
    best.node.push_back(i);
    best.speed.push_back(all[i][candidate].speed);
    if (i == 0) break;
    const Candidate& c = all[i][candidate];
    if (c.by_row) {
      i = begin_of_row[i], candidate = 0;
    } else {
      candidate = static_cast<std::size_t>(c.before);
      --i;
    }
  }
  std::reverse(best.node.begin(), best.node.end());
  std::reverse(best.speed.begin(), best.speed.end());
  return best;
}

}  // namespace

TurnSpeeds choose_speeds(const ProbeProblem& problem, const std::vector<std::size_t>& row_end,
                         const std::vector<Vec>& directions, const TurnSpeeds* near, double width,
                         ProgressScope& progress) {
  return SpeedChoice(problem, row_end, directions).choose(near, width, progress);
}

}  // namespace bahnwerk::probe
