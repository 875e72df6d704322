#include "core/cam/optimal/forced_sections.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace bahnwerk::cam {
namespace {

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

}  // namespace

void fix_forced_sections(LawTask& task) { Forced(task).run(); }

}  // namespace bahnwerk::cam
