#include "core/cam/optimal/relaxation/relaxation_grid.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::cam {
namespace {

class Grid {
 public:
  Grid(const LawTask& task, const std::vector<Range>& ranges) : task_(task), ranges_(ranges) {}

  RelaxationGrid lay(std::size_t cells) {
    out_.periodic = task_.periodic;
    const std::size_t points = task_.points();
    std::vector<double> at;
    for (const Range& range : ranges_) at.push_back((range.min + range.max) / 2);
    if (task_.periodic) at.push_back(at.front() + task_.cycle);
    const double whole = at.back() - at.front();
    double free_length = 0;
    std::size_t free_sections = 0;
    for (std::size_t s = 0; s < task_.sections(); ++s)
      if (!is_known(task_, ranges_, s)) free_length += at[s + 1] - at[s], ++free_sections;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::size_t point = i < points ? i : 0;
      const bool last = i + 1 == at.size(), inside = i > 0 && !last;
      const bool known_before = i > 0 && is_known(task_, ranges_, i - 1);
      const bool known_behind = !last && is_known(task_, ranges_, i);
      const bool jump =
          inside && ranges_[point].fixed() && task_.continuity[point] < 2 && !known_before && !known_behind;
      const bool cell_before = i > 0 && !known_before && at[i] - at[i - 1] > 1e-12 * whole;
      out_.nodes.push_back({at[i], point, jump || last || known_behind});
      if (cell_before)
        add_cell();
      else if (i > 0 && !known_before)
        out_.nodes.back().joined = smooth(at[i], at[i]) + 1;
      if (jump) {
        out_.nodes.push_back({at[i], LawTask::none});
        out_.nodes.back().joined = std::min(task_.continuity[point], 2) + 1;
      }
      if (last || known_behind) continue;
      const double length = at[i + 1] - at[i];
      if (!(length > 1e-12 * whole)) continue;
      // At a drive's limits a short section has as many changes as a long one.
      const double share = task_.largest_peak ? (length / free_length + 1 / static_cast<double>(free_sections)) / 2
                                              : length / free_length;
      const auto count =
          std::max<std::size_t>(4, static_cast<std::size_t>(std::ceil(static_cast<double>(cells) * share)));
      for (std::size_t k = 1; k < count; ++k) {
        out_.nodes.push_back({at[i] + length * static_cast<double>(k) / static_cast<double>(count), LawTask::none});
        add_cell();
      }
    }
    return std::move(out_);
  }

 private:
  /// Returns the order up to which laws are certainly smooth from `from` to `to`.
  int smooth(double from, double to) const {
    int order = 2;
    for (std::size_t k = 0; k < task_.points(); ++k)
      if (task_.joint(k) && !ranges_[k].fixed() && from < ranges_[k].max && to > ranges_[k].min)
        order = std::min(order, task_.continuity[k]);
    return order;
  }

  /// The cell between the last two nodes.
  void add_cell() {
    RelaxationNode &left = out_.nodes[out_.nodes.size() - 2], &right = out_.nodes.back();
    left.used = right.used = true;
    std::size_t section = LawTask::none;
    for (std::size_t k = 0; k < task_.sections(); ++k) {
      const std::size_t end = task_.end_point(k);
      const double until =
          end == 0 && task_.periodic ? ranges_[0].min + task_.cycle : ranges_[task_.periodic ? end : k + 1].min;
      const double slack = 1e-9 * task_.cycle;
      if (left.time >= ranges_[k].max - slack && right.time <= until + slack) section = k;
    }
    out_.cells.push_back({out_.nodes.size() - 2, smooth(left.time, right.time), section});
  }

  const LawTask& task_;
  const std::vector<Range>& ranges_;
  RelaxationGrid out_{};
};

}  // namespace

bool is_known(const LawTask& task, const std::vector<Range>& ranges, std::size_t section) {
  if (task.is_given(section)) return true;
  return task.constant_velocity(section) && ranges[section].fixed() && ranges[task.end_point(section)].fixed();
}

RelaxationGrid lay_grid(const LawTask& task, const std::vector<Range>& ranges, std::size_t cells) {
  return Grid(task, ranges).lay(cells);
}

}  // namespace bahnwerk::cam
