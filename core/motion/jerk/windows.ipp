#pragma once
/// Plans long sections in windows. A window is a range of the section's cells, passed from the state at which the
/// previous window was cut to rest at its own end. After a rough solution the cells that this rest slows are dropped,
/// and the state at the cut is final: slightly inside all limits, so that the next window has an interior. The loss is
/// a small part of the time that a small difference of speed costs.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/section.hpp"
#include "core/numeric/grow.hpp"
#include "core/numeric/windows.hpp"

namespace bahnwerk {

using jerk_section_detail::good_enough;
using jerk_section_detail::last_window;

namespace {

/// Duration, in A/J and in braking times, for which a law is first assumed to differ from that of the whole section
/// before braking begins by the rough profile.
constexpr double jerk_times = 5, braking_times = 5;
/// Half-way through the dropped part, the next window's law must not be faster than the dropped one by more than this;
/// otherwise the window's end has slowed the remaining cells, too.
constexpr double untouched = 1.01;
constexpr double longest_overlap = 64;
/// The largest excess of any window slows the whole section. One that is to blame for more was most likely left in a
/// bad place by the one before, which is then planned again, twice as long. Should that happen often it is the
/// section's own fault.
constexpr double well = 1 + 3e-4;
constexpr std::size_t max_failures(std::size_t windows) { return 3 + windows / 8; }
/// A window is cut where the law keeps all limits between the nodes for this many cells before and behind: the state
/// there is final, and a cell beside it with a smaller share of a limit may have no law at all. The cut lies at most
/// this many cells before the last usable one.
constexpr std::size_t clear_cells = 4, farthest_cut = 64;

}  // namespace

template <int N, int M>
bool JerkSectionPlanner<N, M>::plan_windows(std::size_t window, Progress progress) {
  struct Place {
    std::size_t begin, cells, pieces, number;  // first cell, cells of the window, pieces before it, windows with it
    double slow;
    JerkNode entry;
    LargeVector<JerkNode> tail;
  };
  std::swap(grid_, section_grid_);
  std::swap(rough_, section_rough_);
  const std::size_t n = section_grid_.cells.size();
  double reported = 0;
  pieces_.clear();
  overlap_ = 1;
  std::size_t failures = 0;
  const auto solve = [&](Place& here, Place* before) -> WindowResult<Place> {
    std::size_t end = 0;
    double reaches = reported;
    entry_ = here.entry;
    tail_ = here.tail;
    for (const Start& start : starts()) {
      here.cells = take_window(here.begin, here.cells);
      reaches = std::max(reported, static_cast<double>(here.begin + keep_) / static_cast<double>(n));
      ProgressScope stage_progress(progress.part(reported, reaches), "planning");
      stage_progress.part(0, 0.1);
      pieces_.resize(here.pieces);
      if (const std::size_t least = here.pieces + 2 * here.cells; least > pieces_.capacity())
        grow(pieces_, foreseen(least, static_cast<double>(here.begin) / static_cast<double>(n)), stage_progress);
      attempt(start, stage_progress);
      end = here.begin + keep_;
      if (end < n && !(exit_.b > 0)) slow_ = unlimited;  // the law has no state at the cut
      if (slow_ < start.enough) break;
    }
    // If the section failed as a whole, longer windows would fail, too.
    if (sped_up_ > untouched && overlap_ < longest_overlap && window == usual_window()) {
      overlap_ *= 2;
      return WindowRetry::before;
    }
    if (slow_ > well && ++failures <= max_failures(here.number) && (before || end < n)) {
      (before ? before : &here)->cells *= 2;
      return WindowRetry::before;
    }
    if (!(slow_ < good_enough)) return WindowRetry::none;
    reported = reaches;
    return Place{end, window, pieces_.size(), here.number + 1, std::max(here.slow, slow_), exit_, next_tail_};
  };
  const Place reached = solve_windows(Place{0, window, 0, 1, 1, {}, {}}, n, solve);
  std::swap(grid_, section_grid_);
  std::swap(rough_, section_rough_);
  entry_ = exit_ = {};
  tail_.clear();
  keep_ = all_cells;
  slow_ = reached.slow;
  return reached.begin == n;
}

template <int N, int M>
std::size_t JerkSectionPlanner<N, M>::take_window(std::size_t begin, std::size_t cells) {
  const auto at = [](const LargeVector<double>& of, std::size_t i) {
    return of.begin() + static_cast<std::ptrdiff_t>(i);
  };
  const auto &speeds = section_rough_.b, &durations = section_rough_.duration;
  const std::size_t all = section_grid_.cells.size();
  for (;; cells *= 2) {
    const bool last = static_cast<double>(all - begin) <= last_window * static_cast<double>(cells);
    // The least braking is needed where the profile is slow.
    const std::size_t end = last ? all
                                 : static_cast<std::size_t>(std::min_element(at(speeds, begin + cells - cells / 8),
                                                                             at(speeds, begin + cells + 1)) -
                                                            speeds.begin());
    grid_.slice(section_grid_, begin, end);
    rough_.b.assign(at(speeds, begin), at(speeds, end + 1));
    rough_.duration.assign(at(durations, begin), at(durations, end));
    keep_ = end - begin;
    next_tail_.clear();
    if (last) return cells;
    keep_ = brake<N>(grid_, {machine_, feed_}, options_.path, rough_);
    double braking = 0;
    for (std::size_t c = keep_; c < end - begin; ++c) braking += rough_.duration[c];
    for (double time = overlap_ * (jerk_times * jerk_time_ + braking_times * braking); keep_ > 0 && time > 0;)
      time -= rough_.duration[--keep_];
    while (keep_ > 0 && joint(keep_)) --keep_;  // both sides of a joint belong to one window
    if (2 * keep_ >= cells) return cells;
  }
}

template <int N, int M>
double JerkSectionPlanner<N, M>::speed_up() const {
  const std::size_t n = std::min(tail_.size(), state_.size());
  if (n == 0) return 1;
  // Returns the duration of cell c in the dropped law.
  const auto time = [&](std::size_t c) {
    return 2 * grid_.length(c) / (std::sqrt(tail_[c].b) + std::sqrt(tail_[c + 1].b));
  };
  double all = 0, passed = 0;
  for (std::size_t c = 0; c + 1 < n; ++c) all += time(c);
  std::size_t half = 0;
  while (half + 1 < n && passed < 0.5 * all) passed += time(half++);
  return tail_[half].b > 0 ? std::sqrt(state_[half].b / tail_[half].b) : 1;
}

template <int N, int M>
std::size_t JerkSectionPlanner<N, M>::cut_node() const {
  std::size_t best = keep_;
  double least = unlimited;
  for (std::size_t node = keep_; node > keep_ / 2 && node + farthest_cut > keep_ && least > 1; --node) {
    if (joint(node)) continue;
    double most = 0;
    const std::size_t end = std::min(node + clear_cells, grid_.cells.size());
    for (std::size_t c = node - std::min(node, clear_cells); c < end && most < least; ++c)
      most = std::max(most, peaks_of(c, false).most());
    if (most < least) best = node, least = most;
  }
  return best;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::drop_braking_tail() {
  keep_ = cut_node();
  next_tail_.assign(state_.begin() + static_cast<std::ptrdiff_t>(keep_), state_.end());
  exit_ = state_[keep_];
  state_.resize(keep_ + 1);
  grid_.cut(keep_);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::blend_previous_window() {
  const std::size_t n = std::min(tail_.size(), grid_.cells.size());
  double length = 0, s = 0;
  for (std::size_t i = 0; i < n; ++i) length += grid_.length(i);
  for (std::size_t i = 1; i < n; ++i) {
    s += grid_.length(i - 1);
    const double x = s / length, share = 1 - x * x * (3 - 2 * x), slope = -6 * x * (1 - x) / length;
    const double more = tail_[i].b - state_[i].b;
    state_[i].b += share * more;
    state_[i].a += share * (tail_[i].a - state_[i].a) + 0.5 * slope * more;
  }
}

}  // namespace bahnwerk
