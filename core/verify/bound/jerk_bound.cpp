#include "core/verify/bound/jerk_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// A cell of the relaxation takes this part of the time in which jerk brings an axis to its full acceleration, and
// turns by no more than this, rad; a piece half of it.
constexpr double part_of_ramp = 0.3, widest_turn = 0.05, part_of_onset = 0.002, part_of_section = 1e-4;
constexpr double widest_swing = 0.1;      // of q″ b within a cell, of the axis' acceleration
constexpr double finer = 0.5;             // of both, through kinematics
constexpr std::size_t beyond = 400;       // and cells that windows of the relaxation reach further
constexpr std::size_t stretch = 100'000;  // cells, beyond which the path is cut
constexpr double pieces_per_node = 0.5, more_pieces = 400;
constexpr double min_cells = 60;  // of a section
// An axis that jerk brings to its full acceleration in less than this part of the longest time that another one takes
// does so at once: cells as narrow as its jerk asks for would show nothing else.
constexpr double at_once = 1.0 / 64;
constexpr double no_ramp = 4;  // cells that take longer than so many ramps show nothing of jerk

double sq(double x) { return x * x; }

/// The jerk for which cells are to be narrow enough, per axis.
template <int N>
std::array<double, N> shown_jerk(const BoundGrid<N>& grid) {
  std::array<double, N> shown;
  shown.fill(infinite);
  double longest = 0;  // ramp
  for (std::size_t k = 0; k < grid.axes(); ++k) longest = std::max(longest, grid.acceleration(k) / grid.jerk(k));
  for (std::size_t k = 0; longest > 0 && k < grid.axes(); ++k)
    shown[k] = std::min(grid.jerk(k), grid.acceleration(k) / (at_once * longest));
  return shown;
}

}  // namespace

template <int N>
JerkBound<N>::JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& pulse)
    : grid_(grid),
      pulse_(pulse),
      shown_jerk_(shown_jerk(grid)),
      pieces_(grid, machine.cycle_time, shown_jerk_, pulse),
      dual_(grid, pulse) {
  problem_.acceleration.fill(1), problem_.jerk.fill(infinite);
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    problem_.acceleration[k] = grid.acceleration(k);
    problem_.jerk[k] = grid.jerk(k);
    if (!std::isfinite(grid.jerk(k))) continue;
    limited_ = true;
    if (const double ramp = grid.acceleration(k) / shown_jerk_[k]; ramp < ramp_)
      ramp_ = ramp, acceleration_of_ramp_ = grid.acceleration(k);
  }
}

template <int N>
std::size_t JerkBound<N>::pose(bool rest_first, bool rest_last) {
  problem_.cells.clear(), problem_.steps.clear(), cell_of_.clear();
  problem_.rest_first = rest_first && !pieces_.dropped();
  const double part = grid_.cartesian() ? 1 : finer;
  double time = 0, turn = 0, capped = 0, swing = 0;
  const auto& pieces = pieces_.list();
  const auto& extents = pieces_.extents();
  std::size_t i = 0;
  const auto known = [](const DualPiece<N>& p) {
    return std::isfinite(p.cap) &&
           std::all_of(p.third.begin(), p.third.end(), [](double t) { return std::isfinite(t); });
  };
  for (; problem_.cells.size() < stretch && pieces_.has(i) && known(pieces[i]); ++i) {
    const DualPiece<N>& p = pieces[i];
    double bend = 0;
    for (std::size_t k = 0; k < N; ++k) bend += sq(p.end[k] - p.begin[k]);
    bend = std::sqrt(bend);
    const bool open = !problem_.cells.empty() && time + p.time < JerkPieces<N>::per_cell / 2 * extents[i].spacing &&
                      turn + bend < part * widest_turn && swing + extents[i].swing < part * widest_swing &&
                      problem_.cells.back().length + p.length < extents[i].finest;
    if (!open) problem_.cells.emplace_back(), time = turn = capped = swing = 0, problem_.cells.back().begin = p.begin;
    RelaxationCell<N>& cell = problem_.cells.back();
    if (p.joint.here) {
      RelaxationStep<N> step{problem_.cells.size() - 1, cell.length, {}, p.joint.kink, p.joint.bend};
      for (std::size_t k = 0; k < N; ++k) step.time[k] = p.joint.step[k] / problem_.jerk[k];
      problem_.steps.push_back(step);
    }
    for (std::size_t k = 0; k < N; ++k) cell.way[k] += p.way[k];
    cell.end = p.end;
    cell.length += p.length;
    capped += p.cap * p.length, cell.cap = capped / cell.length;
    time += p.time, turn += bend, swing += extents[i].swing;
    cell_of_.push_back(problem_.cells.size() - 1);
  }
  problem_.rest_last = rest_last && !pieces_.has(i);
  return i;
}

// Any multipliers give a bound. Limits of jerk that the cells are too wide to show may keep the solver from good ones:
// the problem without them has others.
template <int N>
double JerkBound<N>::best_value(std::size_t last) {
  RelaxationOptions options;
  if (!grid_.cartesian()) options.beyond = beyond;
  const auto value = [&] {
    return dual_.value(pieces_.list(), 0, last, cell_of_, problem_, solver_.solve(problem_, options, pulse_));
  };
  double best = value();
  const auto limits = problem_.jerk;
  for (std::size_t k = 0; k < grid_.axes(); ++k)
    if (shown_jerk_[k] < limits[k]) problem_.jerk[k] = infinite;
  if (problem_.jerk != limits) best = std::max(best, value());
  problem_.jerk = limits;
  return best;
}

template <int N>
double JerkBound<N>::duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last) {
  const double length = grid_.nodes()[b.size() - 1].s - grid_.nodes().front().s;
  const double spacing = std::max(std::min(part_of_ramp * ramp_, time / min_cells),
                                  time / (pieces_per_node * static_cast<double>(b.size()) + more_pieces));
  const double first_piece = std::min(part_of_onset * acceleration_of_ramp_ * sq(ramp_) / 6, part_of_section * length);
  double total = 0;
  if (spacing < no_ramp * ramp_) {
    pieces_.begin(b, rest_first, rest_last, spacing, first_piece);
    while (pieces_.has(0)) {
      std::size_t last = pose(rest_first, rest_last);
      if (last > 0) {
        cells_ += problem_.cells.size();
        total += best_value(last);
      } else {  // next to a cusp nothing is known of jerk
        const DualPiece<N>& piece = pieces_.list()[0];
        total += piece.length / std::sqrt(piece.cap);
        last = 1;
      }
      pieces_.drop(last);
    }
  }
  return total * (1 - 1e-12);
}

template class JerkBound<2>;
template class JerkBound<3>;
template class JerkBound<5>;
template class JerkBound<8>;

}  // namespace bahnwerk::verify
