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
      rounding_(coordinate_rounding(problem)) {
  for (std::size_t i = 0; i + 1 < nodes(); ++i) direction_.push_back(unit(point(i + 1) - point(i)));
  measure();
}

void TurnPath::measure() {
  for (std::size_t i = 0; i < nodes(); ++i) {
    size_[i] = {};
    offset_[i] = {};
    if (!turns(i)) continue;
    const Turn turn = this->turn(i);
    size_[i] = turn.size(speeds_.speed[i]);
    offset_[i] = turn.apex({}, size_[i]);
  }
}

void TurnPath::solve(double close, ProgressScope& progress) {
  constexpr int most = 100;
  double before = 1;
  for (int step = 0; step < most; ++step) {
    measure();
    double moved = 0;
    for (std::size_t i = 0; i + 1 < nodes(); ++i) {
      const Vec to_next = way(i);
      const double length = norm(to_next);
      if (!(length > 0)) continue;
      const Vec next = to_next / length;
      moved = std::max(moved, norm(next - direction_[i]));
      direction_[i] = next;
    }
    progress.work(nodes());
    // Where rounding moves directions no step is smaller than the one before.
    if (moved <= close || (moved < 1e-13 && moved >= before)) break;
    before = moved;
  }
  align();
  measure();
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

void TurnPath::repair(ProgressScope& progress) {
  constexpr int most_lowerings = 40;
  constexpr double negligible = 0.02;  // share of the requested speed below which the head rests instead
  const std::vector<double> asked = speeds_.speed;
  std::vector<int> lowered(nodes(), 0);
  std::vector<double> factor(nodes());
  for (;;) {
    std::fill(factor.begin(), factor.end(), 1.0);
    bool right = true;
    // Speeds are lowered by little at first: neighbours give way, too.
    const auto lower = [&](std::size_t i) {
      right = false;
      factor[i] = std::min(factor[i], 1 - std::min(0.5, 0.004 * (1 << std::min(lowered[i], 8))));
    };
    for (std::size_t i = 0; i + 1 < nodes(); ++i) {
      const double v = speeds_.speed[i], w = speeds_.speed[i + 1], length = straight_length(i);
      const bool opposite = dot(way(i), point(i + 1) - point(i)) <= 0;
      const bool fits = !opposite && length >= 0 &&
                        length >= lengthening * min_distance(v, w, limits_along(*problem_, direction_[i]));
      if (fits) continue;
      if (v >= w || length < 0 || opposite) lower(i);
      if (w >= v || length < 0 || opposite) lower(i + 1);
    }
    for (std::size_t i = 1; i + 1 < nodes(); ++i) {
      if (!turns(i)) continue;
      const double deviation =
          turn(i).deviation(speeds_.speed[i], point(i - 1), point(i), point(i + 1), problem_->tolerance + rounding_);
      if (deviation <= problem_->tolerance + rounding_) continue;
      lower(i);
      // The edge's other end moves the straight, too.
      if (i > 1 && turns(i - 1) && lowered[i] > 4) lower(i - 1);
      if (i + 2 < nodes() && turns(i + 1) && lowered[i] > 4) lower(i + 1);
    }
    if (right) return;
    for (std::size_t i = 1; i + 1 < nodes(); ++i) {
      if (factor[i] == 1) continue;
      speeds_.speed[i] *= factor[i];
      if (++lowered[i] > most_lowerings || speeds_.speed[i] < negligible * asked[i]) speeds_.speed[i] = 0;
    }
    progress.work(10 * nodes());
    solve(1e-15, progress);
  }
}

void TurnPath::prefer_rests(const std::vector<std::size_t>& row_end) {
  TurnSpeeds kept;
  std::vector<Vec> directions;
  const auto add = [&](std::size_t node, double speed, Vec direction) {
    kept.node.push_back(node);
    kept.speed.push_back(speed);
    directions.push_back(direction);
  };
  for (std::size_t a = 0; a + 1 < nodes();) {
    std::size_t b = a + 1;
    double turning = straight_duration(a), resting = 0;
    for (; turns(b); ++b) turning += size_[b].duration + straight_duration(b);
    const std::size_t first = speeds_.node[a], last = speeds_.node[b];
    const auto next = [&](std::size_t i) { return std::min(last, row_end[i]); };
    for (std::size_t i = first; i < last && resting <= turning; i = next(i))
      resting += rest_to_rest_duration(*problem_, i, next(i));
    if (resting <= turning) {
      for (std::size_t i = first; i < last; i = next(i))
        add(i, 0, unit(problem_->points[next(i)] - problem_->points[i]));
    } else {
      for (std::size_t i = a; i < b; ++i) add(speeds_.node[i], speeds_.speed[i], direction_[i]);
    }
    a = b;
  }
  kept.node.push_back(speeds_.node.back());
  kept.speed.push_back(0);
  speeds_ = std::move(kept);
  direction_ = std::move(directions);
  size_.resize(nodes());
  offset_.resize(nodes());
  measure();
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
