#include "core/cam/optimal/task/law_task.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/cam/cam_law.hpp"
#include "core/cam/optimal/task/given_sections.hpp"

namespace bahnwerk::cam {
namespace {

// Sections that their limits leave one law alone: a monotone section between equal positions is constant, and one
// whose limit of velocity is its mean velocity is straight. Programs with rows for such limits would have no interior.

constexpr double close = 1e-12;  // positions are of the order of 1

class Forced {
 public:
  explicit Forced(LawTask& task) : task_(task), positions_(task.points()), moves_(task.sections()) {
    const auto take = [&](std::size_t point, const Range& range) {
      positions_[point].min = std::max(positions_[point].min, range.min);
      positions_[point].max = std::min(positions_[point].max, range.max);
    };
    for (const LawTask::Condition& condition : task.conditions)
      if (condition.order == 0) take(condition.point, condition.range);
    for (std::size_t s = 0; s < task.sections(); ++s) {
      if (task.is_given(s)) continue;
      take(s, task.limits[s][0]);
      take(end(s), at_point(task.limits[s][0], s));
      const double cycle = task.periodic && end(s) <= s ? task.cycle : 0;
      length_.push_back({task.at[end(s)].min + cycle - task.at[s].max, task.at[end(s)].max + cycle - task.at[s].min});
      const Range velocity = task.limits[s][1];
      const double more = task.travel_at_end(s);  // moves are those of the position at the point
      moves_[s] = {least_move(velocity.min, length_.back()) - more, -least_move(-velocity.max, length_.back()) - more};
    }
  }

  void run() {
    for (std::size_t s = 0; s < task_.sections(); ++s)
      if (!task_.is_given(s)) move_position_limits(s);
    if (std::all_of(task_.limits.begin(), task_.limits.end(), [](const auto& limit) { return limit[1].free(); }))
      return;
    for (std::size_t round = 0; round < 2 * task_.sections(); ++round)
      for (std::size_t s = 0; s < task_.sections(); ++s) {
        if (task_.is_given(s)) continue;
        Range &from = positions_[s], &to = positions_[end(s)];
        to.min = std::max(to.min, from.min + moves_[s].min);
        to.max = std::min(to.max, from.max + moves_[s].max);
        from.min = std::max(from.min, to.min - moves_[s].max);
        from.max = std::min(from.max, to.max - moves_[s].min);
      }
    if (std::any_of(positions_.begin(), positions_.end(), [](const Range& r) { return !(r.max - r.min >= -close); }))
      return;
    for (std::size_t s = 0; s < task_.sections(); ++s)
      if (!task_.is_given(s)) fix(s);
  }

 private:
  std::size_t end(std::size_t section) const { return task_.periodic ? task_.end_point(section) : section + 1; }
  /// A range of the position at the end of a section, as one at the point where it ends.
  Range at_point(const Range& range, std::size_t section) const {
    const double more = task_.travel_at_end(section);
    return {range.min - more, range.max - more};
  }
  /// The least change of position at a velocity of at least `velocity` in a time within `length`.
  static double least_move(double velocity, const Range& length) {
    return velocity == 0 ? 0 : velocity * (velocity > 0 ? length.min : length.max);
  }

  /// A monotone section keeps a limit of the position if its ends do.
  void move_position_limits(std::size_t s) {
    const Range velocity = task_.limits[s][1];
    if (!(velocity.min >= 0 || velocity.max <= 0)) return;
    const Range limit = std::exchange(task_.limits[s][0], Range{});
    if (limit.free()) return;
    for (const bool at_end : {false, true}) {
      const std::size_t point = at_end ? end(s) : s;
      const Range here = at_end ? at_point(limit, s) : limit;
      const auto known = std::find_if(task_.conditions.begin(), task_.conditions.end(), [&](const auto& condition) {
        return condition.point == point && condition.order == 0;
      });
      if (known == task_.conditions.end()) {
        task_.conditions.push_back({point, 0, here});
        continue;
      }
      const Range both{std::max(known->range.min, here.min), std::min(known->range.max, here.max)};
      if (both.empty())
        task_.limits[s][0] = limit;  // nothing keeps it: it stays, to be named
      else
        known->range = both;
    }
  }

  void fix(std::size_t s) {
    const Range from = positions_[s], to = positions_[end(s)], velocity = task_.limits[s][1];
    if (velocity.fixed() || !(from.max - from.min <= close && to.max - to.min <= close)) return;
    const double move = to.min - from.min;
    const bool slowest = move <= moves_[s].min + close, fastest = move >= moves_[s].max - close;
    if (!slowest && !fastest) return;
    const double forced = slowest ? velocity.min : velocity.max;
    if (forced != 0 && !(task_.at[s].fixed() && task_.at[end(s)].fixed())) return;
    const auto keeps = [](const Range& limit, double value) { return limit.min <= value && value <= limit.max; };
    if (!keeps(task_.limits[s][2], 0) || !keeps(task_.limits[s][3], 0)) return;
    task_.limits[s] = {};
    task_.limits[s][1] = {forced, forced};
    for (const std::size_t point : {s, end(s)}) {
      set(point, 0, positions_[point].min);
      if (!task_.joint(point)) continue;
      for (int r = 1; r <= task_.continuity[point]; ++r) set(point, r, r == 1 ? forced : 0);
    }
  }

  void set(std::size_t point, int order, double value) {
    for (LawTask::Condition& condition : task_.conditions)
      if (condition.point == point && condition.order == order) {
        if (!condition.range.fixed()) condition.range = {value, value};
        return;
      }
    task_.conditions.push_back({point, order, {value, value}});
  }

  LawTask& task_;
  std::vector<Range> positions_;  // what is left for the position at each point
  std::vector<Range> moves_;      // change of position in each section
  std::vector<Range> length_;
};

/// Finds what limits of velocity and ranges of positions say of the positions at points, from section to section. Makes
/// a condition of each position that only one value is left for, a limit that is a number of the velocity of each
/// section with one law, whose other limits that this law keeps are removed, and conditions of the higher derivatives
/// that its neighbours share with it. What cannot hold is left as it is. O(sections²).
void fix_forced_sections(LawTask& task) { Forced(task).run(); }

double middle_of(const Range& range) {
  if (std::isinf(range.min)) return std::isinf(range.max) ? 0 : range.max;
  return std::isinf(range.max) ? range.min : range.min + (range.max - range.min) / 2;
}

/// Span of the positions that points name, or what their derivatives move in the time of a section.
double position_unit(const MotionLawProblem& problem, double time) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](const Range& range) {
    for (const double value : {range.min, range.max})
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  };
  take(problem.end_position(problem.sections() - 1));
  double other = std::abs(problem.travel);
  for (const MotionPoint& point : problem.points) {
    take(point.value(0));
    double factor = 1;
    for (int r = 1; r < static_cast<int>(point.values.size()); ++r) {
      factor *= time / r;
      for (const double value : {point.value(r).min, point.value(r).max})
        if (std::isfinite(value)) other = std::max(other, std::abs(value) * factor);
    }
  }
  if (high > low) return high - low;
  return other > 0 ? other : 1;
}

}  // namespace

bool LawTask::free_angles() const {
  return std::any_of(at.begin(), at.end(), [](const Range& range) { return !range.fixed(); });
}

double LawTask::Given::peak_at(int order, double length) const {
  return peak[static_cast<std::size_t>(order)] / std::pow(length, order);
}

std::optional<double> LawTask::constant_velocity(std::size_t section) const {
  const auto& limit = limits[section];
  if (limit[1].fixed()) return limit[1].min;
  return limit[0].fixed() ? std::optional(0.0) : std::nullopt;
}

double LawTask::to_task(int order) const { return std::pow(unit_time, order) / unit_position; }

std::vector<double> LawTask::breaks(const std::vector<double>& times) const {
  std::vector<double> result = times;
  if (periodic) result.push_back(times.front() + cycle);
  return result;
}

std::vector<double> LawTask::middle() const {
  std::vector<double> result;
  for (const Range& range : at) result.push_back(middle_of(range));
  return result;
}

bool tighten(const LawTask& task, std::vector<Range>& at) {
  for (std::size_t i = 1; i < at.size(); ++i) at[i].min = std::max(at[i].min, at[i - 1].min);
  for (std::size_t i = at.size() - 1; i-- > 0;) at[i].max = std::min(at[i].max, at[i + 1].max);
  if (task.periodic) {
    at.front().min = std::max(at.front().min, at.back().min - task.cycle);
    at.back().max = std::min(at.back().max, at.front().max + task.cycle);
  }
  return std::none_of(at.begin(), at.end(), [](const Range& range) { return range.empty(); });
}

/// Makes a condition of each derivative for which a point and the sections on both sides of it allow a single value:
/// rows that hold each other would leave the programs without interior.
void pin_values(LawTask& task) {
  for (std::size_t point = 0; point < task.points(); ++point)
    for (int r = 0; r < limited_orders; ++r) {
      const auto o = static_cast<std::size_t>(r);
      Range allowed;
      const auto take = [&](const Range& range) {
        allowed.min = std::max(allowed.min, range.min);
        allowed.max = std::min(allowed.max, range.max);
      };
      LawTask::Condition* known = nullptr;
      for (LawTask::Condition& condition : task.conditions)
        if (condition.point == point && condition.order == r) known = &condition;
      if (known) take(known->range);
      if (known && known->range.fixed()) continue;
      const bool begins = task.periodic || point + 1 < task.points();
      const bool ends = task.periodic || point > 0;
      if (begins && ends && task.continuity[point] < r) continue;
      if (begins) take(task.limits[point][o]);
      if (ends) {
        const std::size_t before = point > 0 ? point - 1 : task.sections() - 1;
        const double more = r == 0 ? task.travel_at_end(before) : 0;
        take({task.limits[before][o].min - more, task.limits[before][o].max - more});
      }
      if (!std::isfinite(allowed.min) || !(std::abs(allowed.max - allowed.min) <= 1e-12 * (1 + std::abs(allowed.min))))
        continue;
      if (known)
        known->range = {allowed.min, allowed.min};
      else
        task.conditions.push_back({point, r, {allowed.min, allowed.min}});
    }
}

LawTask make_law_task(const MotionLawProblem& problem) {
  LawTask task;
  const std::size_t sections = problem.sections();
  task.periodic = problem.periodic;
  task.unit_time = *problem.cycle_duration / static_cast<double>(sections);
  task.cycle = static_cast<double>(sections);
  task.unit_position = position_unit(problem, task.unit_time);
  task.travel = problem.periodic ? problem.travel / task.unit_position : 0;
  double low = std::numeric_limits<double>::infinity();
  for (const MotionPoint& point : problem.points)
    if (!point.value(0).free()) low = std::min(low, middle_of(point.value(0)));
  task.origin = std::isfinite(low) ? low : 0;
  const double angle = task.cycle / problem.length;
  const auto scaled = [&](const Range& range, int order) {
    const double factor = task.to_task(order), origin = order == 0 ? task.origin : 0;
    return Range{(range.min - origin) * factor,
                 range.fixed() ? (range.min - origin) * factor : (range.max - origin) * factor};
  };
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const MotionPoint& point = problem.points[i];
    const double from = problem.points.front().at.min;
    task.at.push_back({(point.at.min - from) * angle, (point.at.max - from) * angle});
    task.continuity.push_back(problem.continuity(i));
    for (int r = 0; r < static_cast<int>(point.values.size()); ++r)
      if (!point.value(r).free()) task.conditions.push_back({i, r, scaled(point.value(r), r)});
  }
  for (std::size_t i = 0; i < sections; ++i) {
    std::array<Range, limited_orders> limits;
    for (int r = 0; r < limited_orders; ++r) {
      const auto k = static_cast<std::size_t>(r);
      limits[k] = scaled(problem.points[i].section[k], r);
    }
    task.limits.push_back(limits);
  }
  tighten(task, task.at);
  add_given_sections(problem, task);
  fix_forced_sections(task);
  pin_values(task);
  task.groups = problem.peak_groups();
  const std::array<double, limited_orders> weight = effective_weights(problem);
  for (int r = 1; r < limited_orders; ++r)
    task.weight[static_cast<std::size_t>(r)] = weight[static_cast<std::size_t>(r)] / task.to_task(r);
  if (problem.effort) {
    const double half = (problem.effort->range.max - problem.effort->range.min) / 2;
    const double origin = problem.effort->factor[0] * task.origin;
    task.effort.emplace();
    for (std::size_t r = 0; r < 3; ++r)
      task.effort->factor[r] = problem.effort->factor[r] / task.to_task(static_cast<int>(r)) / half;
    task.effort->range = {(problem.effort->range.min - origin) / half, (problem.effort->range.max - origin) / half};
  }
  std::vector<std::size_t> still;
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    if (problem.points[i].still) still.push_back(i);
  for (std::size_t k = 0; k < still.size(); ++k) {
    if (k + 1 == still.size() && !problem.periodic) break;
    for (const VibrationMode& mode : problem.vibration) {
      const double omega = 2 * std::numbers::pi * mode.frequency * task.unit_time;
      task.vibration.push_back({still[k], still[(k + 1) % still.size()], mode.damping * omega,
                                omega * std::sqrt(1 - mode.damping * mode.damping)});
    }
  }
  return task;
}

}  // namespace bahnwerk::cam
