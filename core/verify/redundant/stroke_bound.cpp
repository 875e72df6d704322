#include "core/verify/redundant/stroke_bound.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/progress_scope.hpp"
#include "core/verify/redundant/head_reach.hpp"
#include "core/verify/redundant/reachable_states.hpp"

namespace bahnwerk {
namespace {

using verify::AxisReach;
using verify::HeadReach;
using verify::reach_at;
using verify::reached;

constexpr double nodes_per_unit = 6;  // of time, √(stroke/acceleration)
constexpr double settled = 4;         // units beyond a stop from full speed that neighbours are looked at
constexpr double piece = 0.05;        // of the least stroke: boxes of the path
constexpr double closed = 1e-5;       // relative
constexpr std::size_t most_nodes = 4000;
// Units of time. Longer sections are left as they are. Accelerations alone allow so much in a longer time that it tells
// nothing, and rounding would count.
constexpr double longest = 100, together = 20;
constexpr int most_doublings = 20;
constexpr double first_step = 0.02;  // of a unit of time
constexpr double rounding = 1e-9;    // of a bound

/// One axis around one section, in units of its stroke and of √(stroke/acceleration), places from the section's begin.
class AxisSection {
 public:
  AxisSection(const AxisLimits& coarse, const AxisLimits& fine, double origin)
      : stroke_(fine.highest),
        time_(std::sqrt(fine.highest / coarse.acceleration)),
        velocity_(coarse.velocity * time_ / stroke_),
        fine_velocity_(fine.velocity * time_ / stroke_),
        fine_acceleration_(fine.acceleration / coarse.acceleration),
        at_rest_(std::min(velocity_, fine_velocity_)),
        origin_(origin),
        lowest_((coarse.lowest - origin) / stroke_),
        highest_((coarse.highest - origin) / stroke_) {}

  double unit() const { return time_; }
  double horizon() const { return (velocity_ + settled) * time_; }

  /// States in which the coarse axis can be at a rest, if the head was on `reach` before. `rests`: it begins there.
  ReachableStates before(const HeadReach& reach, std::size_t axis, bool rests) const {
    const double until = std::min(horizon(), reach.until) / time_;
    const auto n = static_cast<std::size_t>(std::max(until * nodes_per_unit * (1 - 1e-6), 0.0));
    const std::vector<AxisReach> boxes = reach_at(reach, axis, time_ / nodes_per_unit, n);
    if (rests) return box(boxes[0], 0);
    ReachableStates states = box(boxes[n], n == 0 ? at_rest_ : velocity_);
    for (std::size_t i = n; i-- > 0;) {
      states.advance(1 / nodes_per_unit, velocity_);
      limit(states, boxes[i], i == 0 ? at_rest_ : velocity_);
    }
    return states;
  }

  /// Whether a motion may exist if the section takes `duration` and ends at `place`.
  bool possible(double duration, double place, std::size_t axis, const ReachableStates& begin,
                const ReachableStates& end, const HeadReach& forward, const HeadReach& backward) const {
    const auto n = static_cast<std::size_t>(
        std::clamp(std::ceil(duration / time_ * nodes_per_unit), 8.0, static_cast<double>(most_nodes)));
    const double spacing = duration / static_cast<double>(n), h = spacing / time_, way = (place - origin_) / stroke_;
    const std::vector<AxisReach> from = reach_at(forward, axis, spacing, n), to = reach_at(backward, axis, spacing, n);
    // The coarse axis; the fine one, which is where the coarse one is not; what accelerations of either can add up to.
    ReachableStates coarse = begin, fine = begin.subtracted_from(0), free = begin;
    const bool both_count = duration < together * time_;
    ReachableStates by_coarse = ReachableStates::box(0, 0, 0), by_fine = by_coarse;
    for (std::size_t i = 0; i <= n; ++i) {
      if (i > 0) {
        coarse.advance(h, velocity_);
        fine.advance(h, fine_velocity_, fine_acceleration_);
      }
      if (i > 0 && both_count) {
        by_coarse.advance(h, unlimited);
        by_fine.advance(h, unlimited, fine_acceleration_);
        free.coast(h);
      }
      const bool rests = i == 0 || i == n;
      const AxisReach both{std::max(from[i].lowest, to[n - i].lowest), std::min(from[i].highest, to[n - i].highest)};
      limit(coarse, both, rests ? at_rest_ : velocity_);
      fine.limit(-1, 1, rests ? at_rest_ : fine_velocity_);
      if (coarse.empty() || fine.empty()) return false;
    }
    coarse.limit(end);
    coarse.limit(fine.subtracted_from(way));
    if (both_count) {
      by_coarse.limit(by_fine.subtracted_from(way));  // together they bring the head from rest to rest
      coarse.limit(free.plus(by_coarse));
    }
    return !coarse.empty();
  }

 private:
  double low(const AxisReach& r) const { return std::max((r.lowest - origin_) / stroke_ - 1, lowest_); }
  double high(const AxisReach& r) const { return std::min((r.highest - origin_) / stroke_ + 1, highest_); }
  ReachableStates box(const AxisReach& r, double velocity) const {
    return ReachableStates::box(low(r), high(r), velocity);
  }
  void limit(ReachableStates& states, const AxisReach& r, double velocity) const {
    states.limit(low(r), high(r), velocity);
  }

  double stroke_, time_, velocity_, fine_velocity_, fine_acceleration_, at_rest_, origin_, lowest_, highest_;
};

class StrokeBound {
 public:
  StrokeBound(const StrokeBoundTask& task, const std::vector<SectionBound>& sections, ProgressScope& scope)
      : task_(task), sections_(sections), scope_(scope) {
    step_ = unlimited;
    for (std::size_t k = 0; k < axes(); ++k) {
      step_ = std::min(step_, piece * task.fine[k].highest);
      horizon_ = std::max(horizon_, AxisSection(task.coarse[k], task.fine[k], 0).horizon());
    }
  }

  double of(std::size_t section) {
    const SectionBound& s = sections_[section];
    double bound = s.duration;
    if (!far(s)) return bound;
    const PathTask& head = task_.head;
    const std::size_t n = sections_.size();
    const HeadReach before = reached(head, sections_, section, 0, horizon_, step_),
                    behind = reached(head, sections_, section + 1, n, horizon_, step_),
                    forward = reached(head, sections_, section, section + 1, unlimited, step_, false),
                    backward = reached(head, sections_, section + 1, section, unlimited, step_, false);
    if (!(before.until > 0 && behind.until > 0)) return bound;
    const AxisJet begin = head.path.at(s.first, head.path[s.first].s0()),
                  end = head.path.at(s.last - 1, head.path[s.last - 1].s1());
    for (std::size_t k = 0; k < axes(); ++k) {
      const AxisSection axis(task_.coarse[k], task_.fine[k], begin.value[k]);
      if (s.duration > longest * axis.unit()) continue;
      const ReachableStates from = axis.before(before, k, section == 0 && !waits(s.first)),
                            to = axis.before(behind, k, section + 1 == n && !waits(s.last)).reversed();
      const auto possible = [&](double duration) {
        scope_.work(2000);
        return axis.possible(duration, end.value[k], k, from, to, forward, backward);
      };
      if (possible(bound)) continue;
      double step = first_step * axis.unit(), high = bound + step;
      for (int i = 0; i < most_doublings && high < 2 * longest * axis.unit() && !possible(high); ++i) {
        bound = high;
        high += step *= 2;
      }
      while (high - bound > closed * bound) {
        const double middle = 0.5 * (bound + high);
        (possible(middle) ? high : bound) = middle;
      }
    }
    return bound > s.duration ? std::max(s.duration, bound * (1 - rounding)) : s.duration;
  }

 private:
  std::size_t axes() const { return task_.head.path.axes(); }
  /// Whether it is longer than the shortest stroke, and faster than the coarse axes alone may be.
  bool far(const SectionBound& s) const {
    double length = 0, stroke = unlimited;
    bool fast = false;
    for (std::size_t k = 0; k < axes(); ++k) stroke = std::min(stroke, task_.fine[k].highest);
    for (std::size_t i = s.first; i < s.last; ++i) {
      length += task_.head.path[i].s1() - task_.head.path[i].s0();
      for (std::size_t k = 0; k < axes(); ++k) {
        const double feed = task_.head.feeds[i];
        fast = fast || feed * feed > task_.coarse[k].acceleration * task_.fine[k].highest ||
               feed > task_.coarse[k].velocity || feed > task_.fine[k].velocity;
      }
    }
    return fast && length > stroke;
  }
  bool waits(std::size_t segment) const {
    return std::any_of(task_.head.dwells.begin(), task_.head.dwells.end(),
                       [&](const Rest& rest) { return rest.segment == segment && rest.seconds > 0; });
  }

  const StrokeBoundTask& task_;
  const std::vector<SectionBound>& sections_;
  ProgressScope& scope_;
  double step_, horizon_ = 0;
};

}  // namespace

StrokeGain raise_by_stroke(const StrokeBoundTask& task, std::vector<SectionBound>& sections, Progress& progress) {
  ProgressScope scope(progress, "bound", task.progress_from, task.progress_to);
  StrokeBound bound(task, sections, scope);
  std::vector<double> raised(sections.size());
  StrokeGain gain;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    scope.done(static_cast<double>(i) / static_cast<double>(sections.size()));
    raised[i] = bound.of(i);
    const double by = raised[i] - sections[i].duration;
    gain.sections += by > 0;
    gain.duration += by * (1 - rounding);
  }
  for (std::size_t i = 0; i < sections.size(); ++i) sections[i].duration = raised[i];
  return gain;
}

}  // namespace bahnwerk
