/// Long sections window by window. A window is a stretch of the section's cells, passed from the state in which the
/// window before it was left to rest at its own end. Once the solver is roughly there, what that rest slows is thrown
/// away, and the state at the end of what is kept stays as it is from then on: still a little inside of all limits, so
/// that the next window has room to move. Its loss is a small part of the time that it takes to make up for a small
/// difference of speed.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/section.hpp"
#include "core/numeric/grow.hpp"

namespace bahnwerk {

using jerk_section_detail::good_enough;
using jerk_section_detail::last_window;

namespace {

/// Before braking begins, by the rough profile, a law may still differ from that of the whole section: for so long, in
/// A/J and in braking times, is hoped at first.
constexpr double jerk_times = 5, braking_times = 5;
/// Half-way through what was thrown away, the next window's law must not be faster than the one thrown away was by more
/// than this: else the window's end slowed even what was kept.
constexpr double untouched = 1.01;
constexpr double longest_overlap = 64;
/// The largest excess of any window slows the whole section. One that is to blame for more was most likely left in a
/// bad place by the one before, which is then planned again, twice as long. Should that happen often it is the
/// section's own fault.
constexpr double well = 1 + 3e-4;
constexpr std::size_t max_failures(std::size_t windows) { return 3 + windows / 8; }
/// A window is left where the law keeps all limits between the nodes, too, so many cells before and behind: the state
/// there stays, and a cell beside it that is given a smaller share of a limit may have no law at all. So many cells
/// before the last one that is kept may do.
constexpr std::size_t calm_cells = 4, farthest_calm = 64;

}  // namespace

template <int N, int M>
bool JerkSectionPlanner<N, M>::plan_windows(std::size_t window, double from, double to) {
  struct Place {  // where a window begins, and what is known there
    std::size_t begin, cells, pieces;
    double slow;
    JerkNode entry;
    LargeVector<JerkNode> tail;
  };
  std::swap(grid_, section_grid_);
  std::swap(rough_, section_rough_);
  const std::size_t n = section_grid_.cells.size();
  double reported = from;
  pieces_.clear();
  overlap_ = 1;
  std::vector<Place> places{{0, window, 0, 1, {}, {}}};
  for (std::size_t failures = 0; places.back().begin < n;) {
    Place& here = places.back();
    std::size_t end = 0;
    double progress = reported;
    entry_ = here.entry;
    tail_ = here.tail;
    for (const Start& start : starts()) {
      here.cells = take_window(here.begin, here.cells);
      progress =
          std::max(reported, from + (to - from) * static_cast<double>(here.begin + keep_) / static_cast<double>(n));
      ProgressScope pulse(progress_, "planning", reported, progress);
      pulse.part(0, 0.1);
      pieces_.resize(here.pieces);
      if (const std::size_t least = here.pieces + 2 * here.cells; least > pieces_.capacity())
        grow(pieces_, foreseen(least, static_cast<double>(here.begin) / static_cast<double>(n)), pulse);
      attempt(start, pulse);
      end = here.begin + keep_;
      if (end < n && !(exit_.b > 0)) slow_ = unlimited;  // it never came to that
      if (slow_ < start.enough) break;
    }
    // Where the section was lost as a whole, longer windows would be lost, too.
    if (sped_up_ > untouched && overlap_ < longest_overlap && window == usual_window()) {
      overlap_ *= 2;
      places.pop_back();
      continue;
    }
    if (slow_ > well && ++failures <= max_failures(places.size()) && (places.size() > 1 || end < n)) {
      if (places.size() > 1) places.pop_back();
      places.back().cells *= 2;
      continue;
    }
    if (!(slow_ < good_enough)) break;
    reported = progress;
    places.push_back({end, window, pieces_.size(), std::max(here.slow, slow_), exit_, next_tail_});
  }
  std::swap(grid_, section_grid_);
  std::swap(rough_, section_rough_);
  entry_ = exit_ = {};
  tail_.clear();
  keep_ = all_cells;
  slow_ = places.back().slow;
  return places.back().begin == n;
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
    // Where it is slow there is least to brake.
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
    keep_ = brake<N>(grid_, feed_, machine_, options_.path, rough_);
    double braking = 0;
    for (std::size_t c = keep_; c < end - begin; ++c) braking += rough_.duration[c];
    for (double time = overlap_ * (jerk_times * jerk_time_ + braking_times * braking); keep_ > 0 && time > 0;)
      time -= rough_.duration[--keep_];
    while (keep_ > 0 && joint(keep_)) --keep_;  // what holds across a joint is one window's affair
    if (2 * keep_ >= cells) return cells;
  }
}

template <int N, int M>
double JerkSectionPlanner<N, M>::speed_up() const {
  const std::size_t n = std::min(tail_.size(), state_.size());
  if (n == 0) return 1;
  // How long the law thrown away takes for cell c.
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
std::size_t JerkSectionPlanner<N, M>::calm_node() const {
  std::size_t best = keep_;
  double least = unlimited;
  for (std::size_t node = keep_; node > keep_ / 2 && node + farthest_calm > keep_ && least > 1; --node) {
    if (joint(node)) continue;
    double most = 0;
    const std::size_t end = std::min(node + calm_cells, grid_.cells.size());
    for (std::size_t c = node - std::min(node, calm_cells); c < end && most < least; ++c)
      most = std::max(most, peaks_of(c, false).most());
    if (most < least) best = node, least = most;
  }
  return best;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::leave() {
  keep_ = calm_node();
  next_tail_.assign(state_.begin() + static_cast<std::ptrdiff_t>(keep_), state_.end());
  exit_ = state_[keep_];
  state_.resize(keep_ + 1);
  grid_.cut(keep_);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::follow() {
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

template bool JerkSectionPlanner<2, 2>::plan_windows(std::size_t window, double from, double to);
template std::size_t JerkSectionPlanner<2, 2>::take_window(std::size_t begin, std::size_t cells);
template double JerkSectionPlanner<2, 2>::speed_up() const;
template void JerkSectionPlanner<2, 2>::leave();
template void JerkSectionPlanner<2, 2>::follow();
template bool JerkSectionPlanner<2, 3>::plan_windows(std::size_t window, double from, double to);
template std::size_t JerkSectionPlanner<2, 3>::take_window(std::size_t begin, std::size_t cells);
template double JerkSectionPlanner<2, 3>::speed_up() const;
template void JerkSectionPlanner<2, 3>::leave();
template void JerkSectionPlanner<2, 3>::follow();
template bool JerkSectionPlanner<3, 3>::plan_windows(std::size_t window, double from, double to);
template bool JerkSectionPlanner<5, 5>::plan_windows(std::size_t window, double from, double to);
template bool JerkSectionPlanner<8, 8>::plan_windows(std::size_t window, double from, double to);
template std::size_t JerkSectionPlanner<3, 3>::take_window(std::size_t begin, std::size_t cells);
template std::size_t JerkSectionPlanner<5, 5>::take_window(std::size_t begin, std::size_t cells);
template std::size_t JerkSectionPlanner<8, 8>::take_window(std::size_t begin, std::size_t cells);
template double JerkSectionPlanner<3, 3>::speed_up() const;
template double JerkSectionPlanner<5, 5>::speed_up() const;
template double JerkSectionPlanner<8, 8>::speed_up() const;
template void JerkSectionPlanner<3, 3>::leave();
template void JerkSectionPlanner<5, 5>::leave();
template void JerkSectionPlanner<8, 8>::leave();
template void JerkSectionPlanner<3, 3>::follow();
template void JerkSectionPlanner<5, 5>::follow();
template void JerkSectionPlanner<8, 8>::follow();
template bool JerkSectionPlanner<3, 4>::plan_windows(std::size_t window, double from, double to);
template bool JerkSectionPlanner<5, 6>::plan_windows(std::size_t window, double from, double to);
template bool JerkSectionPlanner<8, 9>::plan_windows(std::size_t window, double from, double to);
template std::size_t JerkSectionPlanner<3, 4>::take_window(std::size_t begin, std::size_t cells);
template std::size_t JerkSectionPlanner<5, 6>::take_window(std::size_t begin, std::size_t cells);
template std::size_t JerkSectionPlanner<8, 9>::take_window(std::size_t begin, std::size_t cells);
template double JerkSectionPlanner<3, 4>::speed_up() const;
template double JerkSectionPlanner<5, 6>::speed_up() const;
template double JerkSectionPlanner<8, 9>::speed_up() const;
template void JerkSectionPlanner<3, 4>::leave();
template void JerkSectionPlanner<5, 6>::leave();
template void JerkSectionPlanner<8, 9>::leave();
template void JerkSectionPlanner<3, 4>::follow();
template void JerkSectionPlanner<5, 6>::follow();
template void JerkSectionPlanner<8, 9>::follow();

}  // namespace bahnwerk
