#include "core/motion/acceleration/acceleration_limited.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/acceleration/cell_budget.hpp"
#include "core/motion/acceleration/law_writer.hpp"
#include "core/motion/acceleration/window_solver.hpp"
#include "core/motion/grid/section_repeats.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/numeric/grow.hpp"
#include "core/numeric/windows.hpp"

namespace bahnwerk {

namespace {

constexpr std::size_t max_foreseen = 16'000'000;  // largest number of pieces for which memory is reserved
constexpr double first_growth = 3;                // assumed ratio of cells after dividing to cells before

/// Plans sections of one path.
template <int N>
class SectionPlanner {
 public:
  SectionPlanner(const LanePath<N>& path, const CellBudget& budget, WindowSolver<N>& window)
      : path_(path), budget_(budget), window_(window), window_cells_(static_cast<double>(budget.options.window)) {}

  /// Plans the section over the segments [first, last): at once if it fits a window, otherwise window by window, each
  /// to a stop at its end. The part before the last segment border is used that this stop does not influence and where
  /// the speed is determined by earlier cells, or does not change; the next window begins there. If there is no such
  /// border, or the next window cannot continue from it, windows grow.
  void plan(std::size_t first, std::size_t last, Progress progress, AccelerationLimitedResult& result) {
    const bool fits = reach(first, last, window_cells_) == last;
    struct Place {
      std::size_t begin, pieces, cells;  // segment; sizes of the law before it
      double entry, excess, window;      // v² there, largest excess before it, cells of the window
    };
    const std::size_t first_piece = result.law.pieces().size();
    double grown = first_growth;  // division increases the number of cells, as in the windows before
    const auto fraction = [&](std::size_t segment) {
      const double begin = path_[first].s0(), end = path_[last - 1].s1();
      return ((segment < last ? path_[segment].s0() : end) - begin) / (end - begin);
    };
    const Place begin{first, first_piece, result.cells, 0, 0, window_cells_};
    const Place at = solve_windows(begin, last, [&](Place& here, Place* before) -> WindowResult<Place> {
      result.law.truncate(here.pieces);
      result.cells = here.cells;
      const std::size_t end = fits ? last : reach(here.begin, last, here.window / grown);
      ProgressScope stage_progress(progress.part(fraction(here.begin), fraction(end)), "planning");
      solve(here.begin, end, here.entry, stage_progress, result);
      const std::size_t keep = end == last ? window_.cells() : window_.border();
      if (!window_.enters() || keep == 0) {
        here.window *= 2;
        if (window_.enters() || !before) return WindowRetry::same;
        before->window = here.window;
        return WindowRetry::before;
      }
      write(keep, result, stage_progress);
      grown = std::max(1.0, static_cast<double>(window_.cells()) * grown / here.window);
      return Place{end == last ? last : window_.segment(keep),
                   result.law.pieces().size(),
                   result.cells,
                   window_.node(keep),
                   std::max(here.excess, window_.excess(keep)),
                   here.window};
    });
    if (const double slow = slowing(at.excess); slow > 1) result.law.slow_from(first_piece, slow);
  }

 private:
  /// Returns the end of the segments from `first` on that have about so many cells; one at least.
  std::size_t reach(std::size_t first, std::size_t last, double cells) const {
    std::size_t end = first;
    for (; end < last && cells > 0; ++end) cells -= budget_.cells(end);
    return end;
  }

  void solve(std::size_t first, std::size_t last, double entry, ProgressScope& stage_progress,
             AccelerationLimitedResult& result) {
    result.rounds = std::max(result.rounds, window_.solve(first, last, entry, stage_progress));
    result.window = std::max(result.window, window_.cells());
  }

  /// Returns the factor of durations that takes out an excess.
  double slowing(double excess) const {
    const double most = std::max(excess, 0.0) + budget_.model_error;
    return most > 0 ? std::sqrt(1 + most) * (1 + 1e-12) : 1;
  }

  /// Writes the law of the window's first cells behind the law so far.
  void write(std::size_t cells, AccelerationLimitedResult& result, ProgressScope& stage_progress) {
    stage_progress.report();
    make_room(result.law, cells, stage_progress);
    result.cells += cells;
    LawWriter law(result.law, path_.tool());
    window_.write(cells, law, stage_progress);
  }

  /// Reserves memory for the law of so many cells. A law that has to grow gets what the rest of the path lets expect.
  void make_room(TimeLaw& law, std::size_t cells, ProgressScope& stage_progress) const {
    const double done = path_[window_.segment(cells - 1)].s1() / path_.tool().length();
    law.reserve(cells + 2, std::min(foreseen(law.pieces().size() + cells, done), max_foreseen), stage_progress);
  }

  const LanePath<N>& path_;
  const CellBudget& budget_;
  WindowSolver<N>& window_;
  double window_cells_;
};

template <int N>
AccelerationLimitedResult plan(const PathTask& task, const AccelerationLimitedOptions& options, Progress progress) {
  const LanePath<N> path(task.path);
  const Machine lanes = path.limits(task.machine);
  ProgressScope stage_progress(progress.part(0, 0), "planning");
  const CellBudget budget = cell_budget(path, lanes, task.feeds, options, stage_progress);
  const Sections sections = find_sections(task, options.corner_angle, stage_progress);
  AccelerationLimitedResult result;
  WindowSolver<N> window(path, lanes, budget.options, task.feeds, sections, budget.cells());
  SectionPlanner<N> planner(path, budget, window);
  for_each_section_once(task, sections, progress, result, [&](std::size_t first, std::size_t last, Progress part) {
    planner.plan(first, last, part, result);
    return 0.0;
  });
  return result;
}

}  // namespace

AccelerationLimitedResult plan_acceleration_limited(const PathTask& task, const AccelerationLimitedOptions& options,
                                                    Progress progress) {
  for (const AxisLimits& axis : task.machine.axes)
    if (!(axis.velocity > 0) || !(axis.acceleration > 0) || !std::isfinite(axis.acceleration))
      throw InvalidInput(
          {{{"machine", "axes", axis.name}, "velocity and acceleration must be positive, acceleration finite"}});
  return with_lanes(task.path.axes(), [&](auto n) { return plan<n()>(task, options, progress); });
}

AccelerationLimitedResult plan_acceleration_limited(const Contour& contour, const Machine& machine,
                                                    const AccelerationLimitedOptions& options, Progress progress) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return plan_acceleration_limited(contour_task(path, contour, machine), options, progress);
}

}  // namespace bahnwerk
