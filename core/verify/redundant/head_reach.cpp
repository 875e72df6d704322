#include "core/verify/redundant/head_reach.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::verify {
namespace {

constexpr std::size_t most_pieces = 20'000, most_of_segment = 2'000;
constexpr double turns = 8;  // pieces of a curved segment, at least

/// Returns the least time from a rest to a place at the distance `way`.
double from_rest(double way, const AxisLimits& axis) {
  const double full = axis.velocity / axis.acceleration, accelerating = 0.5 * axis.velocity * full;
  return way <= accelerating || !(axis.velocity < unlimited) ? std::sqrt(2 * way / axis.acceleration)
                                                             : full + (way - accelerating) / axis.velocity;
}

class Walk {
 public:
  Walk(const PathTask& task, bool forward, double horizon, double step)
      : task_(task), forward_(forward), horizon_(horizon), step_(step) {}

  /// Starts at a place of a segment.
  void begin(std::size_t segment, double s) {
    const AxisJet q = task_.path.at(segment, s);
    reach_.pieces.push_back({0, boxes(q, q, 0)});
    reach_.until = unlimited;
  }
  /// Advances along a section. Returns false once the horizon is reached.
  bool section(const SectionBound& bound, bool dwells) {
    if (dwells) wait(forward_ ? bound.first : bound.last);
    const double left = time_;
    const std::size_t enter = forward_ ? bound.first : bound.last - 1;
    rest_ = task_.path.at(enter, edge(enter, true));
    double by_feed = 0;
    for (std::size_t i = 0; i < bound.last - bound.first; ++i)
      if (!segment(forward_ ? bound.first + i : bound.last - 1 - i, left, by_feed)) {
        reach_.until = std::min(after_, horizon_);
        return false;
      }
    time_ = left + bound.duration;
    if (time_ < horizon_) return true;
    reach_.until = horizon_;
    return false;
  }
  HeadReach result() { return std::move(reach_); }

 private:
  /// Returns the positions at which a segment is entered, or left.
  double edge(std::size_t segment, bool entered) const {
    return entered == forward_ ? task_.path[segment].s0() : task_.path[segment].s1();
  }
  void wait(std::size_t segment) { time_ += dwell_before(task_, segment) * (1 - 1e-12); }
  bool segment(std::size_t segment, double left, double& by_feed) {
    const double length = task_.path[segment].s1() - task_.path[segment].s0();
    const bool straight = task_.path.linear(segment);
    const double wished = std::max(std::ceil(length / step_), straight ? 1 : turns);
    const auto n = static_cast<std::size_t>(std::min(wished, static_cast<double>(most_of_segment)));
    const double enter = edge(segment, true), leave = edge(segment, false), part = length / static_cast<double>(n);
    AxisJet from = task_.path.at(segment, enter);
    for (std::size_t i = 0; i < n; ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(n);
      const AxisJet to = task_.path.at(segment, i + 1 == n ? leave : enter + share * (leave - enter));
      after_ = std::max(after_, left + std::max(by_feed, by_axes(from)) * (1 - 1e-9));
      if (after_ > horizon_ || reach_.pieces.size() == most_pieces) return false;
      reach_.pieces.push_back({after_, boxes(from, to, part)});
      by_feed += part / task_.feeds[segment];
      from = to;
    }
    return true;
  }
  double by_axes(const AxisJet& q) const {
    double time = 0;
    for (std::size_t k = 0; k < task_.path.axes(); ++k)
      time = std::max(time, from_rest(std::abs(q.value[k] - rest_.value[k]), task_.machine.axes[k]));
    return time;
  }
  /// Returns the boxes of the ellipsoid around a curve.
  std::vector<AxisReach> boxes(const AxisJet& from, const AxisJet& to, double part) const {
    const double length = part * (1 + 1e-9);
    double chord = 0;
    for (std::size_t k = 0; k < task_.path.axes(); ++k) {
      const double d = to.value[k] - from.value[k];
      chord += d * d;
    }
    const double across = std::max(length * length - chord, 0.0);
    std::vector<AxisReach> list;
    for (std::size_t k = 0; k < task_.path.axes(); ++k) {
      const double d = to.value[k] - from.value[k], along = chord > 0 ? d * d / chord : 1;
      const double half = 0.5 * std::sqrt(length * length * along + across * std::max(1 - along, 0.0)) + rounding;
      const double middle = 0.5 * (from.value[k] + to.value[k]);
      list.push_back({middle - half, middle + half});
    }
    return list;
  }

  static constexpr double rounding = 1e-9;  // mm

  const PathTask& task_;
  bool forward_;
  double horizon_, step_;
  double time_ = 0;   // when the section can be begun
  double after_ = 0;  // earliest end of the piece added last, s
  AxisJet rest_;      // where it begins
  HeadReach reach_;
};

}  // namespace

double dwell_before(const PathTask& task, std::size_t segment) {
  auto rest = std::lower_bound(task.dwells.begin(), task.dwells.end(), segment,
                               [](const Rest& r, std::size_t s) { return r.segment < s; });
  double seconds = 0;
  for (; rest != task.dwells.end() && rest->segment == segment; ++rest) seconds += rest->seconds;
  return seconds;
}

HeadReach reached(const PathTask& task, const std::vector<SectionBound>& sections, std::size_t from, std::size_t to,
                  const HeadReachOptions& options) {
  Walk walk(task, to >= from, options.horizon, options.step);
  const bool ends = from == sections.size();
  const std::size_t segment = ends ? sections.back().last - 1 : sections[from].first;
  walk.begin(segment, ends ? task.path[segment].s1() : task.path[segment].s0());
  if (to >= from)
    for (std::size_t i = from; i < to && walk.section(sections[i], options.dwells || i != from);) ++i;
  else
    for (std::size_t i = from; i > to && walk.section(sections[i - 1], options.dwells || i != from);) --i;
  return walk.result();
}

std::vector<AxisReach> reach_at(const HeadReach& reach, std::size_t axis, double spacing, std::size_t count) {
  std::vector<AxisReach> list(count + 1, {-unlimited, unlimited});
  AxisReach all{unlimited, -unlimited};
  std::size_t next = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) * spacing * (1 + 1e-9);
    if (!(t < reach.until)) break;
    for (; next < reach.pieces.size() && reach.pieces[next].after <= t; ++next) {
      all.lowest = std::min(all.lowest, reach.pieces[next].boxes[axis].lowest);
      all.highest = std::max(all.highest, reach.pieces[next].boxes[axis].highest);
    }
    list[i] = all;
  }
  return list;
}

}  // namespace bahnwerk::verify
