#include "core/verify/bound/jerk_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numeric/windows.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// A cell of the relaxation takes this part of the time in which jerk brings an axis to its full acceleration, and
// turns by no more than this, rad; a piece half of it.
constexpr double part_of_ramp = 0.3, widest_turn = 0.05, part_of_onset = 0.004, part_of_section = 2e-4;
constexpr double widest_swing = 0.1;  // largest change of q″ b within a cell, as a part of the axis' acceleration
// The largest v² of the pieces of a cell over the smallest: the relaxation knows their mean, in which a trough is lost.
constexpr double alike = 1.2;
constexpr std::size_t beyond = 200;  // cells by which windows of the relaxation extend further
// These accuracies are worth less than 1e-5 of the bound, through kinematics 1e-4.
constexpr double gap = 1e-4, violation = 1e-5, kinematic_gap = 3e-3, kinematic_violation = 1e-3;
constexpr double pieces_per_node = 0.5, more_pieces = 400;
constexpr double min_cells = 60;  // least number of cells of a section
// An axis that jerk brings to its full acceleration in less than this part of another axis' longest time counts as
// immediate: cells narrow enough for its jerk would show nothing more.
constexpr double at_once = 1.0 / 64;
constexpr double no_ramp = 4;  // cells that take longer than so many ramps show nothing of jerk
// Sections of so few cells, if jerk makes them longer by more than this part, are bounded on fine cells as well: some
// milliseconds for each at most.
constexpr std::size_t few_cells = 1000;
constexpr double much_longer = 2e-3;

/// The jerk for which cells are to be narrow enough, per axis.
template <int N>
std::array<double, N> shown_jerk(const BoundGrid<N>& grid) {
  std::array<double, N> shown;
  shown.fill(infinite);
  double longest = 0;  // longest ramp of an axis
  for (std::size_t k = 0; k < grid.axes(); ++k) longest = std::max(longest, grid.acceleration(k) / grid.jerk(k));
  for (std::size_t k = 0; longest > 0 && k < grid.axes(); ++k)
    shown[k] = std::min(grid.jerk(k), grid.acceleration(k) / (at_once * longest));
  return shown;
}

}  // namespace

template <int N>
JerkBound<N>::JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& progress)
    : grid_(grid),
      progress_(progress),
      shown_jerk_(shown_jerk(grid)),
      pieces_(grid, machine.cycle_time, shown_jerk_, progress),
      dual_(grid, progress) {
  problem_.acceleration.fill(1), problem_.jerk.fill(infinite);
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    problem_.acceleration[k] = grid.acceleration(k);
    problem_.jerk[k] = grid.jerk(k);
    if (!std::isfinite(grid.jerk(k))) continue;
    limited_ = true;
    if (const double ramp = grid.acceleration(k) / shown_jerk_[k]; ramp < ramp_)
      ramp_ = ramp, acceleration_of_ramp_ = grid.acceleration(k);
  }
  attempts_.resize(1), attempts_[0].jerk = problem_.jerk;
  Row fewer = problem_.jerk;
  for (std::size_t k = 0; k < grid.axes(); ++k)
    if (shown_jerk_[k] < fewer[k]) fewer[k] = infinite;
  if (fewer != problem_.jerk) attempts_.emplace_back().jerk = fewer;
}

template <int N>
bool JerkBound<N>::pose(std::size_t most) {
  const auto& pieces = pieces_.list();
  const auto& extents = pieces_.extents();
  const auto known = [](const DualPiece<N>& p) {
    return std::isfinite(p.cap) &&
           std::all_of(p.third.begin(), p.third.end(), [](double t) { return std::isfinite(t); });
  };
  for (std::size_t i = cell_of_.size(); pieces_.has(i) && known(pieces[i]); ++i) {
    const DualPiece<N>& p = pieces[i];
    double q2 = 0;
    for (std::size_t k = 0; k < N; ++k) q2 += sq(p.end[k] - p.begin[k]);
    q2 = std::sqrt(q2);
    const bool open = !problem_.cells.empty() && time_ + p.time < pieces_.per_cell() / 2 * extents[i].spacing &&
                      turn_ + q2 < widest_turn && swing_ + extents[i].swing < widest_swing &&
                      problem_.cells.back().length + p.length < extents[i].finest &&
                      std::max(fastest_, p.cap) < alike * std::min(slowest_, p.cap);
    if (!open) {
      if (problem_.cells.size() == most) return true;
      ++cells_;
      problem_.cells.emplace_back().begin = p.begin;
      time_ = turn_ = capped_ = swing_ = 0;
      slowest_ = fastest_ = p.cap;
    }
    RelaxationCell<N>& cell = problem_.cells.back();
    if (p.joint.here) {
      RelaxationStep<N> step{
          problem_.cells.size() - 1, cell.length, {}, p.joint.tangent_jump, p.joint.acceleration_step};
      for (std::size_t k = 0; k < N; ++k) step.time[k] = p.joint.step[k] / problem_.jerk[k];
      problem_.steps.push_back(step);
    }
    for (std::size_t k = 0; k < N; ++k) cell.displacement[k] += p.displacement[k];
    cell.end = p.end;
    cell.length += p.length;
    capped_ += p.cap * p.length, cell.cap = capped_ / cell.length;
    slowest_ = std::min(slowest_, p.cap), fastest_ = std::max(fastest_, p.cap);
    time_ += p.time, turn_ += q2, swing_ += extents[i].swing;
    cell_of_.push_back(problem_.cells.size() - 1);
  }
  return false;
}

template <int N>
void JerkBound<N>::forget(std::size_t first) {
  const auto cells = static_cast<std::ptrdiff_t>(first);
  const auto piece = std::lower_bound(cell_of_.begin(), cell_of_.end(), first);
  pieces_.drop(static_cast<std::size_t>(piece - cell_of_.begin()));
  cell_of_.erase(cell_of_.begin(), piece);
  for (std::size_t& cell : cell_of_) cell -= first;
  problem_.cells.erase(problem_.cells.begin(), problem_.cells.begin() + cells);
  auto& steps = problem_.steps;
  steps.erase(steps.begin(), std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s.cell >= first; }));
  for (RelaxationStep<N>& step : steps) step.cell -= first;
  for (Attempt& attempt : attempts_) attempt.solver.drop(first);
}

// Any multipliers give a bound if they are those of the whole section.
template <int N>
double JerkBound<N>::stretch(bool rest_first, bool rest_last) {
  using Windows = RelaxationWindows<N>;
  RelaxationOptions options;
  options.gap = gap, options.violation = violation;
  if (!grid_.cartesian()) options.beyond = beyond, options.gap = kinematic_gap, options.violation = kinematic_violation;
  problem_.cells.clear(), problem_.steps.clear(), cell_of_.clear();
  for (Attempt& attempt : attempts_) attempt.total = 0;
  const WindowLengths lengths = Windows::lengths(options);
  const Row limits = problem_.jerk;
  struct Place {
    std::size_t begin = 0, done = 0;  // cell from which the window counts, piece up to which values are added up
  };
  std::size_t end = std::numeric_limits<std::size_t>::max();  // behind the last cell, once it is known
  solve_windows(Place(), end, [&](const Place& here, auto*) {
    const std::size_t first = here.begin - std::min(here.begin, options.beyond);  // the first cell of those at hand
    if (!pose(here.begin - first + lengths.whole)) end = first + problem_.cells.size();
    if (problem_.cells.empty()) return here;
    const Window window = lengths.at(here.begin, end);
    const bool more = window.keep < end;
    const std::size_t sure =
        window.keep - first - (more ? Windows::fading / 2 + 2 : 0);  // behind the final multipliers
    problem_.rest_first = rest_first && !pieces_.dropped(),
    problem_.rest_last = !more && rest_last && !pieces_.has(cell_of_.size());
    const auto until =
        static_cast<std::size_t>(std::lower_bound(cell_of_.begin(), cell_of_.end(), sure) - cell_of_.begin());
    for (Attempt& attempt : attempts_) {
      problem_.jerk = attempt.jerk;
      const RelaxationMultipliers<N>& found = attempt.solver.next(problem_, here.begin - first, options, progress_);
      attempt.total += dual_.value(pieces_.list(), here.done, until, cell_of_, problem_, found);
    }
    problem_.jerk = limits;
    const std::size_t before = cell_of_.size();
    if (more) forget(window.keep - first - options.beyond);
    return Place{window.keep, until - (before - cell_of_.size())};
  });
  pieces_.drop(cell_of_.size());
  double best = 0;
  for (const Attempt& attempt : attempts_) best = std::max(best, attempt.total);
  return best;
}

template <int N>
double JerkBound<N>::whole(bool rest_first, bool rest_last) {
  double total = 0;
  while (pieces_.has(0)) {
    total += stretch(rest_first, rest_last);
    if (!pieces_.has(0)) break;
    // Next to a cusp nothing is known of jerk.
    const DualPiece<N>& piece = pieces_.list()[0];
    total += piece.length / std::sqrt(piece.cap);
    pieces_.drop(1);
  }
  return total * (1 - 1e-12);
}

template <int N>
double JerkBound<N>::duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last) {
  const double length = grid_.path_length(grid_.nodes()[b.size() - 1]) - grid_.path_length(grid_.nodes().front());
  const double spacing = std::max(std::min(part_of_ramp * ramp_, time / min_cells),
                                  time / (pieces_per_node * static_cast<double>(b.size()) + more_pieces));
  if (!(spacing < no_ramp * ramp_)) return 0;
  const double first_cell = std::min(part_of_onset * acceleration_of_ramp_ * sq(ramp_) / 6, part_of_section * length),
               first_piece = first_cell / std::floor(pieces_.per_cell());
  const std::size_t before = cells_;
  pieces_.begin(b, rest_first, rest_last, spacing, first_piece, false);
  const double found = whole(rest_first, rest_last);
  if (!grid_.cartesian() || cells_ - before > few_cells || found < (1 + much_longer) * time) return found;
  pieces_.begin(b, rest_first, rest_last, spacing, first_piece, true);
  return std::max(found, whole(rest_first, rest_last));
}

template class JerkBound<2>;
template class JerkBound<3>;
template class JerkBound<5>;
template class JerkBound<8>;

}  // namespace bahnwerk::verify
