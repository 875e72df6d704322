#include "core/probe/arcs/turn_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/probe/straight/straight.hpp"

namespace bahnwerk::probe {
namespace {

constexpr double lengthening =
    1 + 1e-12;  // factor of the length that a straight needs, so that the profile's own rounding never fails

Vec unit(Vec x) { return x / norm(x); }

}  // namespace

TurnPath::TurnPath(const ProbeProblem& problem, TurnSpeeds speeds)
    : problem_(&problem),
      speeds_(std::move(speeds)),
      size_(speeds_.node.size()),
      offset_(speeds_.node.size()),
      rounding_(coordinate_rounding(problem)),
      unsettled_(nodes()),
      unchecked_(nodes()) {
  for (std::size_t i = 0; i + 1 < nodes(); ++i) direction_.push_back(unit(point(i + 1) - point(i)));
}

void TurnPath::measure(std::size_t i) {
  size_[i] = {};
  offset_[i] = {};
  if (!turns(i)) return;
  const Turn turn = this->turn(i);
  size_[i] = turn.size(speeds_.speed[i]);
  offset_[i] = turn.apex({}, size_[i]);
}

void TurnPath::solve(double close, ProgressScope& progress) {
  constexpr int most = 100;
  double before = 1;
  for (int step = 0; step < most; ++step) {
    const std::vector<std::size_t> changed = unsettled_.take();
    for (const std::size_t i : changed) measure(i), unchecked_.add(i);
    double moved = 0;
    const auto turn_edge = [&](std::size_t i) {
      const Vec to_next = way(i);
      const double length = norm(to_next);
      if (!(length > 0)) return;
      const Vec next = to_next / length;
      if (next == direction_[i]) return;
      moved = std::max(moved, norm(next - direction_[i]));
      direction_[i] = next;
      unsettled_.add(i), unsettled_.add(i + 1);
    };
    for (const std::size_t i : changed) {
      if (i > 0) turn_edge(i - 1);
      if (i + 1 < nodes()) turn_edge(i);
    }
    progress.work(changed.size());
    // Where rounding moves directions no step is smaller than the one before.
    if (moved <= close || (moved < 1e-13 && moved >= before)) break;
    before = moved;
  }
  for (const std::size_t i : unsettled_.take()) {
    measure(i), unchecked_.add(i);
    if (close > 1e-15) unsettled_.add(i);
  }
}

void TurnPath::align() {
  for (std::size_t i = 1; i + 1 < nodes(); ++i)
    if (turns(i) && !turn(i).any()) direction_[i] = direction_[i - 1];
}

double TurnPath::straight_length(std::size_t i) const {
  return dot(way(i), direction_[i]) - size_[i].length - size_[i + 1].length;
}

double TurnPath::straight_duration(std::size_t i) const {
  const double length = std::max(0.0, straight_length(i));
  return straight_profile(length, speeds_.speed[i], speeds_.speed[i + 1], limits_along(*problem_, direction_[i]))
      .duration;
}

bool TurnPath::straight_fits(std::size_t i) const {
  const double length = straight_length(i);
  return length >= 0 && dot(way(i), point(i + 1) - point(i)) > 0 &&
         length >=
             lengthening * min_distance(speeds_.speed[i], speeds_.speed[i + 1], limits_along(*problem_, direction_[i]));
}

bool TurnPath::turn_fits(std::size_t i) const {
  const Turn::Edges edges{point(i - 1), point(i), point(i + 1), problem_->tolerance + rounding_};
  return turn(i).deviation(speeds_.speed[i], edges, 1) <= 1;
}

void TurnPath::repair(ProgressScope& progress) {
  constexpr int most_lowerings = 40;
  constexpr double negligible = 0.02;  // share of the requested speed below which the head rests instead
  const std::vector<double> asked = speeds_.speed;
  std::vector<int> lowered(nodes(), 0);
  std::vector<double> factor(nodes(), 1.0);
  NodeSet lower_nodes(nodes());
  lower_nodes.take();
  for (;;) {
    const std::vector<std::size_t> seen = unchecked_.take();
    // Speeds are lowered by little at first: neighbours fall, too.
    const auto lower = [&](std::size_t i) {
      if (!turns(i)) return;
      factor[i] = std::min(factor[i], 1 - std::min(0.5, 0.004 * (1 << std::min(lowered[i], 8))));
      lower_nodes.add(i);
    };
    const auto check_straight = [&](std::size_t i) {
      if (straight_fits(i)) return;
      const double v = speeds_.speed[i], w = speeds_.speed[i + 1];
      const bool crossed = straight_length(i) < 0 || dot(way(i), point(i + 1) - point(i)) <= 0;
      if (v >= w || crossed) lower(i);
      if (w >= v || crossed) lower(i + 1);
    };
    const auto check_turn = [&](std::size_t i) {
      if (!turns(i) || turn_fits(i)) return;
      lower(i);
      // The edge's other end moves the straight, too.
      if (lowered[i] > 4) lower(i - 1), lower(i + 1);
    };
    for (const std::size_t i : seen) {
      if (i > 0) check_straight(i - 1);
      if (i + 1 < nodes()) check_straight(i);
      check_turn(i);
    }
    progress.work(10 * seen.size());
    const std::vector<std::size_t> list = lower_nodes.take();
    if (list.empty()) break;
    for (const std::size_t i : list) {
      speeds_.speed[i] *= factor[i];
      factor[i] = 1;
      if (++lowered[i] > most_lowerings || speeds_.speed[i] < negligible * asked[i]) speeds_.speed[i] = 0;
      unsettled_.add(i), unchecked_.add(i);
    }
    solve(1e-15, progress);
  }
  align();
}

double TurnPath::duration() const {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < nodes(); ++i) sum += size_[i].duration + straight_duration(i);
  return sum;
}

ProbeMotion TurnPath::write(ProgressScope& progress) const {
  MotionWriter writer(*problem_);
  for (std::size_t i = 0; i + 1 < nodes(); ++i) {
    const std::size_t number = speeds_.node[i];
    progress.work(64);
    if (turns(i)) {
      turn(i).append(writer, speeds_.speed[i], point(i), number);
    } else if (i > 0) {
      writer.rest(number);
    }
    if (!turns(i) && !turns(i + 1)) {
      append_rest_to_rest(writer, *problem_, number, speeds_.node[i + 1]);
      continue;
    }
    const double length = std::max(0.0, straight_length(i));
    writer.aim(point(i) + offset_[i] + size_[i].length * direction_[i]);
    append_straight(
        writer,
        straight_profile(length, speeds_.speed[i], speeds_.speed[i + 1], limits_along(*problem_, direction_[i])),
        direction_[i], number);
  }
  writer.aim(problem_->points.back());
  return writer.finish();
}

}  // namespace bahnwerk::probe
