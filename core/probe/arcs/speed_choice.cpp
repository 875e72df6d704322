#include "core/probe/arcs/speed_choice.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/bisection.hpp"
#include "core/probe/straight/straight.hpp"

namespace bahnwerk::probe {
namespace {
constexpr double length_rounding = 1e-9;  // relative to an edge: room for the rounding of directions
constexpr int speed_steps = 50;           // steps of the bisection for a speed: to 1e-15 of the interval
constexpr int reach_steps = 40;
}  // namespace

SpeedChoice::SpeedChoice(const ProbeProblem& problem, const std::vector<std::size_t>& row_end)
    : problem_(problem), row_end_(row_end), rounding_(coordinate_rounding(problem)) {}

/// Entry and exit are in the tube, and the turn has room on its edges. Both get harder with the speed.
double SpeedChoice::largest_speed(std::size_t i, const Turn& turn, Vec in, Vec out) const {
  const Vec before = problem_.points[i - 1], point = problem_.points[i], after = problem_.points[i + 1];
  const double room = std::min(norm(point - before), norm(after - point));
  const auto fits = [&](double speed) {
    const TurnSize size = turn.size(speed);
    if (size.length > room) return false;
    const Vec apex = turn.apex(point, size);
    return distance_from_edge(apex - size.length * in, before, point) <= problem_.tube(i - 1) + rounding_ &&
           distance_from_edge(apex + size.length * out, point, after) <= problem_.tube(i) + rounding_;
  };
  if (fits(problem_.speed)) return problem_.speed;
  return bisect(0, problem_.speed, 0, speed_steps, fits).low;
}

std::vector<double> SpeedChoice::reachable(const std::vector<Turn>& turns, const std::vector<Vec>& directions,
                                           bool backwards, std::vector<double> speed) const {
  const std::size_t n = speed.size();
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const std::size_t i = backwards ? n - 1 - k : k, last = backwards ? i + 1 : i - 1, edge = std::min(i, last);
    const ProfileLimits limits = limits_along(problem_, directions[edge]);
    const double length = norm(problem_.points[edge + 1] - problem_.points[edge]) * (1 - 2 * length_rounding);
    const auto reaches = [&](double v) {
      const double room = length - turns[i].size(v).length;
      const auto from = [&](double u) {
        const double straight = room - (u > 0 ? turns[last].size(u).length : 0);
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

std::vector<Turn> SpeedChoice::turns_of(const std::vector<Vec>& directions) const {
  const std::size_t n = problem_.points.size();
  std::vector<Turn> turns;
  for (std::size_t i = 0; i < n; ++i)
    turns.emplace_back(problem_, directions[i > 0 ? i - 1 : 0], directions[std::min(i, n - 2)]);
  return turns;
}

std::vector<double> SpeedChoice::largest_speeds(const std::vector<Vec>& directions) const {
  const std::vector<Turn> turns = turns_of(directions);
  std::vector<double> speed(problem_.points.size(), 0.0);
  for (std::size_t i = 1; i + 1 < speed.size(); ++i)
    speed[i] = largest_speed(i, turns[i], directions[i - 1], directions[i]);
  const std::vector<double> reached = reachable(turns, directions, false, speed),
                            braked = reachable(turns, directions, true, speed);
  for (std::size_t i = 0; i < speed.size(); ++i) speed[i] = std::min(reached[i], braked[i]);
  return speed;
}

void SpeedChoice::connect(std::size_t edge, Vec direction, const Candidates& from, Candidates& to) const {
  const Vec chord = problem_.points[edge + 1] - problem_.points[edge];
  const ProfileLimits limits = limits_along(problem_, direction);
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

TurnSpeeds SpeedChoice::choose(const std::vector<Vec>& directions, const std::vector<double>& shares,
                               const TurnSpeeds* near, const std::vector<double>& factors, ProgressScope& progress,
                               const std::vector<double>& anywhere) const {
  const std::size_t n = problem_.points.size();
  std::vector<double> speed_before(n, 0);
  if (near)
    for (std::size_t i = 0; i < near->node.size(); ++i) speed_before[near->node[i]] = near->speed[i];
  const std::vector<Turn> turns = turns_of(directions);
  const std::vector<double> largest = largest_speeds(directions);
  progress.work(10 * n);
  std::vector<Candidates> all(n);
  all[0].resize(1);
  std::size_t row_begin = 0;
  for (std::size_t i = 1; i < n; ++i) {
    Candidates& here = all[i];
    here.resize(1);  // the first candidate is a rest
    if (i + 1 < n) {
      const Turn& turn = turns[i];
      const double most = largest[i];
      const auto add = [&](double speed) {
        if (!(speed > 0)) return;
        Candidate c;
        c.speed = std::min(speed, most);
        for (const Candidate& other : here)
          if (std::abs(other.speed - c.speed) <= 1e-9 * problem_.speed) return;
        c.size = turn.size(c.speed);
        c.offset = turn.apex({}, c.size);
        here.push_back(c);
      };
      add(speed_before[i]);
      for (const double share : speed_before[i] > 0 ? factors : shares)
        add(share * (speed_before[i] > 0 ? speed_before[i] : most));
      if (near && speed_before[i] > 0) {
        add(most);
        add(speed_before[i - 1]);
        add(speed_before[i + 1]);
        for (const double share : anywhere) add(share * most);
      }
    }
    connect(i - 1, directions[i - 1], all[i - 1], here);
    if (row_end_[row_begin] == i) {
      if (i - row_begin > 1 && all[row_begin][0].time < unlimited) {
        const double time = all[row_begin][0].time + rest_to_rest_duration(problem_, row_begin, i);
        if (time <= here[0].time) here[0].time = time, here[0].by_row = true;
      }
      row_begin = i;
    }
    progress.work(here.size() * all[i - 1].size());
  }
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

}  // namespace bahnwerk::probe
