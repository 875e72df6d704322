#include "core/motion/acceleration/window_solver.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/progress_scope.hpp"
#include "core/motion/acceleration/spread.hpp"

namespace bahnwerk {

namespace {

constexpr double bearable_excess = 2e-7;              // largest excess that needs no late divisions and rounds
constexpr int late_divisions = 24, late_rounds = 40;  // largest numbers of divisions and rounds for an excess
constexpr std::size_t block = 512;                    // cells that stay in a cache

}  // namespace

template <int N>
WindowSolver<N>::WindowSolver(const LanePath<N>& path, const Machine& lanes, const AccelerationLimitedOptions& options,
                              const std::vector<double>& feed, const Sections& sections, double cells)
    : path_(path),
      machine_(lanes),
      options_(options),
      feed_(feed),
      limit_(lanes),
      chain_(grid_, feed, sections, lanes,
             options.keep_reserve ? std::optional(options.braking_reserve) : std::nullopt),
      marks_(grid_, chain_) {
  // There are more cells where the law switches. Unwritten memory costs nothing.
  grid_.reserve(static_cast<std::size_t>(2.1 * std::min(cells, 2 * static_cast<double>(options.window))) + 16);
}

template <int N>
std::size_t WindowSolver<N>::border() const {
  for (std::size_t c = chain_.unaffected(share_); c > 0; --c)
    if (grid_.cells[c].segment != grid_.cells[c - 1].segment &&
        (chain_.slack(c) || (chain_.steady(c - 1) && chain_.steady(c))))
      return c;
  return 0;
}

template <int N>
std::size_t WindowSolver<N>::solve(std::size_t first, std::size_t last, double entry, ProgressScope& progress) {
  progress.part(0, 0.2);
  grid_.build(path_, first, last, {machine_, feed_}, options_.grid, progress);
  progress.half_of_rest();
  solve_all(entry, progress);
  std::size_t rounds = 1;
  for (int division = 0; division < options_.max_divisions && marks_.mark(excess_, options_.tolerance, progress);
       ++division, ++rounds) {
    progress.half_of_rest();
    divide(progress);
    solve_dirty(progress);
  }
  // The rest of an excess slows the whole section: a few cells, where a slow feed is reached within nanometres or
  // limits change abruptly, may need more rounds than the others.
  const double bearable = std::max(bearable_excess, options_.excess);
  for (int division = 0; division < late_divisions && marks_.mark_excess(excess_, bearable); ++division, ++rounds) {
    progress.half_of_rest();
    divide(progress);
    solve_dirty(progress);
  }
  // The limits inside the cells come after the grid.
  const auto goes_on = [&](int round) {
    return round < options_.max_rounds || (round < late_rounds && excess(cells()) > bearable);
  };
  for (int round = 0; goes_on(round) && shrink_shares(progress); ++round, ++rounds) {
    progress.half_of_rest();
    solve_dirty(progress);
  }
  progress.half_of_rest();
  return rounds;
}

template <int N>
double WindowSolver<N>::excess(std::size_t cells) const {
  double acceleration = 0, velocity = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    acceleration = std::max(acceleration, excess_[c].acceleration);
    velocity = std::max(velocity, excess_[c].velocity);
  }
  return std::max(acceleration, velocity);
}

/// Returns the share of its limits that a smooth cell starts with. It leaves what the law may bulge between the cell's
/// ends: the acceleration of an axis along a saturated law is a parabola of height ≈ turn²/8 there.
template <int N>
double WindowSolver<N>::share(std::size_t c) const {
  const Lanes<N> turn = grid_.right(c).d1 - grid_.left(c).d1;
  return 1 - 0.15 * sum(turn * turn);
}

template <int N>
template <class F>
void WindowSolver<N>::for_all_of_cells(F&& f) {
  f(laws_), f(ends_), f(excess_), f(share_);
}

/// Computes the law of a curved cell. `v` is the speed at its left end; returns that at its right end.
template <int N>
[[gnu::always_inline]] inline double WindowSolver<N>::shape(std::size_t c, double v) {
  const double v2 = std::sqrt(chain_.node(c + 1)), h = grid_.length(c);
  ends_[c] = grid_.right(c).s;
  if (!grid_.cells[c].straight && h > 0) laws_[c] = cell_law(chain_.node(c), v, chain_.middle(c), v2, h);
  return v2;
}

/// Checks whether a curved cell exceeds a limit between its stations.
template <int N>
void WindowSolver<N>::check_cell(std::size_t c) {
  const GridCell& cell = grid_.cells[c];
  const Station<N>& left = grid_.stations[cell.station];
  const CellEnds<N> ends{left, (&left)[1], chain_.node(c), chain_.node(c + 1)};
  excess_[c] = {-1, -1};
  if (cell.straight || !(ends.length() > 0)) return;
  if (!cell.regular() || !smooth_excess<N>(ends, laws_[c], limit_, excess_[c]))
    excess_[c] = cell_excess<N>(ends, laws_[c], cell, limit_, feed_[cell.segment]);
}

/// Computes the speeds of all cells and their laws, block by block: reading the cells once more costs as much as the
/// work on them.
template <int N>
void WindowSolver<N>::solve_all(double entry, ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  for_all_of_cells([n](auto& values) {
    values.clear();  // a larger array takes nothing over
    values.resize(n);
  });
  chain_.start(entry);
  for (std::size_t end = n; end > 0;) {
    const std::size_t begin = (end - 1) / block * block;
    progress(begin, n);
    chain_.backward(begin, end, [this](std::size_t c) { return share_[c] = share(c); });
    end = begin;
  }
  for (std::size_t begin = 0; begin < n; begin += block) {
    const std::size_t end = std::min(n, begin + block);
    progress.done(static_cast<double>(begin) / static_cast<double>(n));
    progress.work(4 * (end - begin));  // looking between the stations may take microseconds per cell
    double v = std::sqrt(chain_.node(begin));
    chain_.forward(begin, end, share_, [&](std::size_t c) { v = shape(c, v); });
    for (std::size_t c = begin; c < end; ++c) check_cell(c);
  }
}

/// Divides the marked cells; their parts are dirty.
template <int N>
void WindowSolver<N>::divide(ProgressScope& progress) {
  const LargeVector<std::uint8_t>& parts = marks_.parts;
  grid_.divide(path_, marks_.parts, progress);
  const std::size_t n = grid_.cells.size();
  chain_.divided(parts, progress);
  for_all_of_cells([&](auto& values) { spread(values, parts, n, progress); });
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

/// Computes speeds and laws of dirty cells, and of all that these influence.
template <int N>
void WindowSolver<N>::solve_dirty(ProgressScope& progress) {
  chain_.update(share_, dirty_, progress);
  for (std::size_t c = 0; (c = first_set(dirty_, c)) != no_flag; ++c) {
    progress.work(4);  // the size of this list does not give the number of cells
    shape(c, std::sqrt(chain_.node(c)));
    check_cell(c);
  }
}

/// Gives a smaller share of their limits to cells that exceed them a little. Returns false if none does.
template <int N>
bool WindowSolver<N>::shrink_shares(ProgressScope& progress) {
  bool any = false;
  dirty_.resize(grid_.cells.size());
  for (std::size_t c = 0; c < grid_.cells.size(); ++c) {
    progress(c, grid_.cells.size());
    dirty_[c] = excess_[c].acceleration > options_.excess;
    if (!dirty_[c]) continue;
    share_[c] /= 1 + 1.2 * excess_[c].acceleration;
    any = true;
  }
  return any;
}

template <int N>
void WindowSolver<N>::write(std::size_t cells, LawWriter& law, ProgressScope& progress) const {
  bool cruises = false;  // constant speed through the whole cell: such cells of one segment become one piece
  for (std::size_t c = 0; c < cells; ++c) {
    progress(c, cells);
    const GridCell& cell = grid_.cells[c];
    const bool follows = c > 0 && grid_.cells[c - 1].segment == cell.segment, cruised = follows && cruises;
    const double s1 = follows ? ends_[c - 1] : 0, s2 = ends_[c], b1 = chain_.node(c), b2 = chain_.node(c + 1);
    cruises = !cell.straight && b1 == b2 && b1 == chain_.middle(c);
    if (cell.straight)
      law.straight(cell.segment, {s1, b1}, {s2, b2}, chain_.acceleration(c), chain_.cap(c));
    else if (cruises && cruised && s2 > s1)
      law.extend(cell.segment, s2);
    else if (s2 > s1)
      law.cell(laws_[c], cell.segment, s1, s2);
  }
}

template class WindowSolver<2>;
template class WindowSolver<3>;
template class WindowSolver<5>;
template class WindowSolver<8>;

}  // namespace bahnwerk
