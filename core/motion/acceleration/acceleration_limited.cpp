#include "core/motion/acceleration/acceleration_limited.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/errors.hpp"
#include "core/motion/acceleration/cell_law.hpp"
#include "core/motion/acceleration/division_marks.hpp"
#include "core/motion/acceleration/law_writer.hpp"
#include "core/motion/acceleration/speed_chain.hpp"
#include "core/motion/acceleration/spread.hpp"
#include "core/motion/grid/section_repeats.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/motion/law/repeated_law.hpp"

namespace bahnwerk {

namespace {

// Memory: about 270 bytes per cell of a window, 72 for the law of each. Beyond the usual number cells become wider, up
// to this factor; the gap then contains the cost.
constexpr double widest = 10, max_turn = 160000;  // rad
// Cells wider than these are divided so many times at most, which brings less than their width costs; but limits inside
// them are tightened until what is exceeded is little, for the largest excess slows all.
constexpr double wide = 2, very_wide = 4;
constexpr int divisions_of_wide = 3, divisions_of_very_wide = 1, rounds_of_wide = 12;
constexpr double excess_of_wide = 1e-6;
constexpr double graded_cells = 8;                        // more at both ends of a grid
constexpr std::size_t sampled_segments = 256;             // sample whose cells estimate the number of all cells
constexpr double long_segment = 1000, few_curved = 4096;  // bends: too many to sample, too few to care
constexpr std::size_t max_foreseen = 16'000'000;          // pieces
constexpr double first_growth = 3;                        // cells after dividing per cell before
// Allowed excess over a limit that wide cells may not show, as a margin, and its ratio to the error of their model.
// Verifying a law once more costs more than such a margin.
constexpr double usual_margin = 1e-5, least_share = 100, most_share = 1000;
constexpr double bearable_excess = 2e-7;
constexpr int late_divisions = 24, late_rounds = 40;
constexpr std::size_t block = 512;  // cells that stay in a cache

/// Quantities that determine the number of cells: the curved segments and their turn, rad.
struct CurvedParts {
  double curved = 0, turn = 0;
  double count(double angle) const { return curved + turn / angle; }
};

template <int N>
CurvedParts curved_parts(const LanePath<N>& path, std::size_t segment) {
  return path.linear(segment) ? CurvedParts{} : CurvedParts{1, total_turn(path, segment, segment + 1)};
}

template <int N>
class SectionPlanner {
 public:
  /// `each`: of every segment; `all`: of the path; `density`: cells per bend.
  SectionPlanner(const LanePath<N>& path, const Machine& lanes, const AccelerationLimitedOptions& options,
                 const std::vector<double>& feed, const Sections& sections, const std::vector<CurvedParts>& each,
                 const CurvedParts& all, double density, double model_error, Progress& progress)
      : path_(path),
        curved_parts_(each),
        machine_(lanes),
        options_(options),
        feed_(feed),
        progress_(progress),
        density_(density),
        model_error_(model_error),
        limit_(lanes),
        chain_(grid_, feed, sections, lanes,
               options.keep_reserve ? std::optional(options.braking_reserve) : std::nullopt),
        marks_(grid_, chain_) {
    const double cells = static_cast<double>(path.size()) + density * all.count(options.grid.angle);
    one_window_ = cells <= static_cast<double>(options.window);
    // Where the law switches there are more cells. Unwritten memory costs nothing.
    grid_.reserve(static_cast<std::size_t>(2.1 * std::min(cells, 2 * static_cast<double>(options.window))) + 16);
  }

  /// The section over the segments [first, last); `from` … `to` is its share of progress.
  void plan(std::size_t first, std::size_t last, double from, double to, AccelerationLimitedResult& result) {
    if (!one_window_ && reach(first, last, static_cast<double>(options_.window)) < last)
      return plan_long(first, last, from, to, result);
    ProgressScope stage_progress(progress_, "planning", from, to);
    solve_window(first, last, 0, stage_progress, result);
    slow_ = slowing(excess(grid_.cells.size()));
    emit(grid_.cells.size(), result, stage_progress);
  }

 private:
  /// The end of the segments from `first` on that have about so many cells; one at least.
  std::size_t reach(std::size_t first, std::size_t last, double cells) const {
    std::size_t end = first;
    for (; end < last && cells > 0; ++end)
      cells -= std::max(1.0, density_ * curved_parts_[end].count(options_.grid.angle));
    return end;
  }

  /// Plans window by window, each to a stop at its end. The part before the last segment border is used that this stop
  /// does not influence and where the speed is determined by earlier cells, or does not change; the next window begins
  /// there. If there is no such border, or the next window cannot continue from it, windows grow.
  void plan_long(std::size_t first, std::size_t last, double from, double to, AccelerationLimitedResult& result) {
    struct Place {
      std::size_t segment, pieces, cells;
      double entry, most;
    };
    const std::size_t first_piece = result.law.pieces().size();
    Place at{first, first_piece, result.cells, 0, 0}, before = at;
    // Division increases their number, as in the windows before.
    double window = static_cast<double>(options_.window), grown = first_growth;
    const auto fraction = [&](std::size_t segment) {
      const double begin = path_[first].s0(), end = path_[last - 1].s1();
      return from + (to - from) * ((segment < last ? path_[segment].s0() : end) - begin) / (end - begin);
    };
    slow_ = 1;
    while (at.segment < last) {
      const std::size_t end = reach(at.segment, last, window / grown);
      ProgressScope stage_progress(progress_, "planning", fraction(at.segment), fraction(end));
      solve_window(at.segment, end, at.entry, stage_progress, result);
      const std::size_t keep = end == last ? grid_.cells.size() : border();
      if (!chain_.enters() || keep == 0) {
        if (!chain_.enters()) at = before;
        result.law.truncate(at.pieces);
        window *= 2;
        continue;
      }
      before = at;
      emit(keep, result, stage_progress);
      grown = std::max(1.0, static_cast<double>(grid_.cells.size()) * grown / window);
      at = {end == last ? last : grid_.cells[keep].segment, result.law.pieces().size(), result.cells, chain_.node(keep),
            std::max(at.most, excess(keep))};
    }
    if (const double slow = slowing(at.most); slow > 1) result.law.slow_from(first_piece, slow);
  }

  std::size_t border() const {
    for (std::size_t c = chain_.unaffected(share_); c > 0; --c)
      if (grid_.cells[c].segment != grid_.cells[c - 1].segment &&
          (chain_.slack(c) || (chain_.steady(c - 1) && chain_.steady(c))))
        return c;
    return 0;
  }

  void solve_window(std::size_t first, std::size_t last, double entry, ProgressScope& stage_progress,
                    AccelerationLimitedResult& result) {
    stage_progress.part(0, 0.2);
    grid_.build(path_, first, last, feed_, machine_, options_.grid, stage_progress);
    stage_progress.half_of_rest();
    solve(entry, stage_progress);
    std::size_t rounds = 1;
    for (int division = 0;  // first the grid …
         division < options_.max_divisions && marks_.mark(excess_, options_.tolerance, stage_progress);
         ++division, ++rounds) {
      stage_progress.half_of_rest();
      divide(stage_progress);
      solve_dirty(stage_progress);
    }
    // The rest of an excess slows the whole section: a few cells, where a slow feed is reached within nanometres or
    // limits change abruptly, may need more rounds than the others.
    const double bearable = std::max(bearable_excess, options_.excess);
    for (int division = 0; division < late_divisions && marks_.mark_excess(excess_, bearable); ++division, ++rounds) {
      stage_progress.half_of_rest();
      divide(stage_progress);
      solve_dirty(stage_progress);
    }
    const auto goes_on = [&](int round) {
      return round < options_.max_rounds || (round < late_rounds && excess(grid_.cells.size()) > bearable);
    };
    for (int round = 0; goes_on(round) && shrink_shares(stage_progress);
         ++round, ++rounds) {  // … then the limits in its cells
      stage_progress.half_of_rest();
      solve_dirty(stage_progress);
    }
    stage_progress.half_of_rest();
    result.rounds = std::max(result.rounds, rounds);
    result.window = std::max(result.window, grid_.cells.size());
  }

  double excess(std::size_t cells) const {
    double acceleration = 0, velocity = 0;
    for (std::size_t c = 0; c < cells; ++c) {
      acceleration = std::max(acceleration, excess_[c].acceleration);
      velocity = std::max(velocity, excess_[c].velocity);
    }
    return std::max(acceleration, velocity);
  }
  double slowing(double excess) const {
    const double most = std::max(excess, 0.0) + model_error_;
    return most > 0 ? std::sqrt(1 + most) * (1 + 1e-12) : 1;
  }

  /// Smooth cells leave what the law may bulge between their ends: the acceleration of an axis along a saturated law is
  /// a parabola of height ≈ turn²/8 there.
  double share(std::size_t c) const {
    const Lanes<N> turn = grid_.right(c).d1 - grid_.left(c).d1;
    return 1 - 0.15 * sum(turn * turn);
  }

  template <class F>
  void for_all_of_cells(F&& f) {
    f(laws_), f(ends_), f(excess_), f(share_);
  }

  /// Speeds of all cells and their laws, block by block: reading the cells once more costs as much as the work on them.
  void solve(double entry, ProgressScope& stage_progress) {
    const std::size_t n = grid_.cells.size();
    for_all_of_cells([n](auto& values) {
      values.clear();  // a larger array takes nothing over
      values.resize(n);
    });
    chain_.start(entry);
    for (std::size_t end = n; end > 0;) {
      const std::size_t begin = (end - 1) / block * block;
      stage_progress(begin, n);
      chain_.backward(begin, end, [this](std::size_t c) { return share_[c] = share(c); });
      end = begin;
    }
    for (std::size_t begin = 0; begin < n; begin += block) {
      const std::size_t end = std::min(n, begin + block);
      stage_progress.done(static_cast<double>(begin) / static_cast<double>(n));
      stage_progress.work(4 * (end - begin));  // looking between the stations may take microseconds per cell
      double v = std::sqrt(chain_.node(begin));
      chain_.forward(begin, end, share_, [&](std::size_t c) { v = shape(c, v); });
      for (std::size_t c = begin; c < end; ++c) check_cell(c);
    }
  }

  /// Divides the marked cells; their parts are dirty.
  void divide(ProgressScope& stage_progress) {
    const LargeVector<std::uint8_t>& parts = marks_.parts;
    grid_.divide(path_, marks_.parts, stage_progress);
    const std::size_t n = grid_.cells.size();
    chain_.divided(parts, stage_progress);
    for_all_of_cells([&](auto& values) { spread(values, parts, n, stage_progress); });
    dirty_.assign(n, 0);
    std::size_t first = 0;
    for (const std::uint8_t count : parts) {
      for (std::size_t c = first; count > 1 && c < first + count; ++c) {
        dirty_[c] = 1;
        share_[c] = share(c);
      }
      first += count;
    }
  }

  /// Speeds and laws of dirty cells, and of all that these influence.
  void solve_dirty(ProgressScope& stage_progress) {
    chain_.update(share_, dirty_, stage_progress);
    for (std::size_t c = 0; (c = first_set(dirty_, c)) != no_flag; ++c) {
      stage_progress.work(4);  // the size of this list does not give the number of cells
      shape(c, std::sqrt(chain_.node(c)));
      check_cell(c);
    }
  }

  /// The law of a curved cell. `v` is the speed at its left end; returns that at its right end.
  [[gnu::always_inline]] double shape(std::size_t c, double v) {
    const double v2 = std::sqrt(chain_.node(c + 1)), h = grid_.length(c);
    ends_[c] = grid_.right(c).s;
    if (!grid_.cells[c].straight && h > 0) laws_[c] = cell_law(chain_.node(c), v, chain_.middle(c), v2, h);
    return v2;
  }

  /// Checks whether a curved cell exceeds a limit between its stations.
  void check_cell(std::size_t c) {
    const GridCell& cell = grid_.cells[c];
    const Station<N>&l = grid_.stations[cell.station], &r = (&l)[1];
    const double h = r.s - l.s;
    excess_[c] = {-1, -1};
    if (cell.straight || !(h > 0)) return;
    if (!cell.regular() || !smooth_excess<N>(l, r, h, laws_[c], chain_.node(c), chain_.node(c + 1), limit_, excess_[c]))
      excess_[c] = cell_excess<N>(l, r, h, laws_[c], cell, limit_, feed_[cell.segment]);
  }

  /// Cells that exceed a limit a little get a smaller share of it. False = none does.
  bool shrink_shares(ProgressScope& stage_progress) {
    bool any = false;
    dirty_.resize(grid_.cells.size());
    for (std::size_t c = 0; c < grid_.cells.size(); ++c) {
      stage_progress(c, grid_.cells.size());
      dirty_[c] = excess_[c].acceleration > options_.excess;
      if (!dirty_[c]) continue;
      share_[c] /= 1 + 1.2 * excess_[c].acceleration;
      any = true;
    }
    return any;
  }

  /// For the law of so many cells: all that the rest of the path lets expect, where the law has to grow.
  void make_room(TimeLaw& law, std::size_t cells, ProgressScope& stage_progress) const {
    const double done = path_[grid_.cells[cells - 1].segment].s1() / path_.tool().length();
    law.reserve(cells + 2, std::min(foreseen(law.pieces().size() + cells, done), max_foreseen), stage_progress);
  }

  /// The law of the first cells.
  void emit(std::size_t cells, AccelerationLimitedResult& result, ProgressScope& stage_progress) {
    stage_progress.report();
    make_room(result.law, cells, stage_progress);
    result.cells += cells;
    LawWriter law(result.law, path_.tool(), slow_);
    bool cruises = false;  // constant speed through the whole cell: such cells of one segment become one piece
    for (std::size_t c = 0; c < cells; ++c) {
      stage_progress(c, cells);
      const GridCell& cell = grid_.cells[c];
      const bool follows = c > 0 && grid_.cells[c - 1].segment == cell.segment, cruised = follows && cruises;
      const double s1 = follows ? ends_[c - 1] : 0, s2 = ends_[c], b1 = chain_.node(c), b2 = chain_.node(c + 1);
      cruises = !cell.straight && b1 == b2 && b1 == chain_.middle(c);
      if (cell.straight)
        law.straight(cell.segment, s1, s2, b1, b2, chain_.acceleration(c), chain_.cap(c));
      else if (cruises && cruised && s2 > s1)
        law.extend(cell.segment, s2);
      else if (s2 > s1)
        law.cell(laws_[c], cell.segment, s1, s2);
    }
  }

  const LanePath<N>& path_;
  const std::vector<CurvedParts>& curved_parts_;
  const Machine& machine_;  // limits of the lanes
  const AccelerationLimitedOptions& options_;
  const std::vector<double>& feed_;
  Progress& progress_;
  double density_, model_error_, slow_ = 1;  // the last: by what the law is slowed
  bool one_window_ = true;                   // enough for any section
  AxisBounds<N> limit_;
  Grid<N> grid_;
  SpeedChain<N> chain_;
  UnsetVector<double> share_, ends_;  // ends: path length of cells' right ends from the begin of their segment
  UnsetVector<Excess> excess_;
  UnsetVector<CellLaw> laws_;  // laws of curved cells, before slowing
  CellFlags dirty_;            // whose laws change with the shares
  DivisionMarks<N> marks_;
};

/// Cells per bend, from some of the segments: 1, more where curvature changes fast.
template <int N>
double cell_density(const LanePath<N>& path, const Machine& lanes, const std::vector<double>& feed,
                    const AccelerationLimitedOptions& options, ProgressScope& stage_progress) {
  Grid<N> grid;
  double cells = 0, all = 0;
  const std::size_t n = path.size(), looks = std::min(n / 8, sampled_segments);
  for (std::size_t k = 0; k < looks; ++k) {
    const std::size_t i = k * n / looks;
    const double count = curved_parts(path, i).count(options.grid.angle);
    if (!(count > 0 && count < long_segment)) continue;
    grid.build(path, i, i + 1, feed, lanes, options.grid, stage_progress);
    cells += std::max(1.0, static_cast<double>(grid.cells.size()) - graded_cells);
    all += count;
  }
  return all > 0 ? std::max(1.0, cells / all) : 1.0;
}

template <int N>
AccelerationLimitedResult plan(const PathTask& task, const AccelerationLimitedOptions& options, Progress& progress,
                               double from, double to) {
  const LanePath<N> path(task.path);
  const Machine lanes = path.limits(task.machine);
  ProgressScope stage_progress(progress, "planning", from, from);
  CurvedParts all;
  std::vector<CurvedParts> each(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i % 4096 == 4095) stage_progress.report();
    each[i] = curved_parts(path, i);
    all.curved += each[i].curved, all.turn += each[i].turn;
  }
  if (all.turn > max_turn)
    throw InvalidInput(
        {{{"contour"},
          "the contour turns by " + std::to_string(static_cast<long>(all.turn)) + " rad in all, more than the " +
              std::to_string(static_cast<long>(max_turn)) + " that fit into memory"}});
  const double count = all.count(options.grid.angle),
               density = count > few_curved ? cell_density(path, lanes, task.feeds, options, stage_progress) : 1;
  const double wider = std::clamp(std::max(options.width, density * count / options.usual_cells), 1.0, widest);
  AccelerationLimitedOptions fitted = options;
  fitted.grid.angle *= wider;
  fitted.grid.hermite *= wider * wider * wider * wider;  // the error falls with the fourth power of a cell's width
  fitted.tolerance *= wider * wider;
  if (wider > wide) {
    fitted.max_divisions = wider > very_wide ? divisions_of_very_wide : divisions_of_wide;
    fitted.max_rounds = std::max(fitted.max_rounds, rounds_of_wide);
    fitted.excess = std::max(fitted.excess, excess_of_wide);
  }
  const double model_error =
      wider > 1 ? std::clamp(usual_margin, least_share * fitted.grid.hermite, most_share * fitted.grid.hermite) : 0;
  const Sections sections = find_sections(task, options.corner_angle, stage_progress);
  AccelerationLimitedResult result;
  SectionPlanner<N> planner(path, lanes, fitted, task.feeds, sections, each, all, density, model_error, progress);
  for_each_section_once(
      task, sections, progress, from, to, result,
      [&](std::size_t first, std::size_t last, double begin, double end) {
        planner.plan(first, last, begin, end, result);
        return 0.0;
      },
      [&](auto&&... what) { repeat_law(result.law, what...); });
  return result;
}

}  // namespace

AccelerationLimitedResult plan_acceleration_limited(const PathTask& task, const AccelerationLimitedOptions& options,
                                                    Progress& progress, double from, double to) {
  for (const AxisLimits& axis : task.machine.axes)
    if (!(axis.velocity > 0) || !(axis.acceleration > 0) || !std::isfinite(axis.acceleration))
      throw InvalidInput(
          {{{"machine", "axes", axis.name}, "velocity and acceleration must be positive, acceleration finite"}});
  return with_lanes(task.path.axes(), [&](auto n) { return plan<n()>(task, options, progress, from, to); });
}

AccelerationLimitedResult plan_acceleration_limited(const Contour& contour, const Machine& machine,
                                                    const AccelerationLimitedOptions& options, Progress& progress,
                                                    double from, double to) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return plan_acceleration_limited(contour_task(path, contour, machine), options, progress, from, to);
}

}  // namespace bahnwerk
