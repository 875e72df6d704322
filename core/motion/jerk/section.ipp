#pragma once
/// The order in which a section is planned.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/jerk/section.hpp"
#include "core/motion/profile/profile.hpp"

namespace bahnwerk {

using jerk_section_detail::full_share;
using jerk_section_detail::good_enough;
using jerk_section_detail::last_window;

namespace {

constexpr std::size_t few_cells = 200;  // a section with fewer cells is too short for windows

/// While the end of a window is open, the solver uses this part of every limit, to this accuracy, so that the next
/// window can continue from the state at which the window is cut.
constexpr double open_share = 1 - 1e-2, open_violation = 2e-3;

/// A solver that has not converged and violates rows by more has diverged: once per section it starts again from its
/// first guess; that result is accepted.
constexpr double diverged = 1e-2;

/// Ceilings of v² are lowered this often, where the law has to be slowed by more than the factor below.
constexpr int max_lowerings = 8;
constexpr double bearable_slow = 1.002;

/// Through kinematics axes turn, in their lanes, far quicker than a law can change: cells may be wider there. What they
/// are too wide for is divided, or found by measuring the path itself, so often at most.
constexpr double kinematic_angle = 5;
constexpr int exact_rounds = 4;

/// A smaller share of the jerk limit may remove only a small part of an excess inside a cell: in the last rounds, for a
/// few cells of many, shares fall by this many times the excess.
constexpr double late_tightening = 3;

/// Speed at rest is rounding within this part of a cell from its end.
constexpr double rest = 1e-6;

}  // namespace

template <int N, int M>
void JerkSectionPlanner<N, M>::plan(std::size_t first, std::size_t last, Progress part, JerkLimitedResult& result) {
  ProgressScope progress(part, "planning");
  progress.part(0, 0.1);
  if (last == first + 1 && alone(first, result)) return;
  build(first, last, progress);
  const std::size_t n = grid_.cells.size(), window = usual_window();
  best_duration_ = unlimited;
  bool done =
      window > 0 && static_cast<double>(n) > last_window * static_cast<double>(window) && plan_windows(window, part);
  if (!done) {
    const auto starts = this->starts();
    const std::size_t next = usual_start() + 1;
    done = plan_whole(starts[0], progress);
    for (std::size_t i = 1; i < starts.size() && !done; ++i) {
      build(first, last, progress);  // cells may have been divided: they are built again
      // If a long section fails, shorter windows may succeed.
      done = (i == next && window > 0 && n > few_cells && plan_windows(n / 4, part)) || plan_whole(starts[i], progress);
    }
    if (!done) {
      build(first, last, progress);
      plan_under_ceilings(progress);
    }
    if (!done && best_duration_ == unlimited) {  // any law serves, optimal or not
      build(first, last, progress);
      done = plan_whole({0, 0}, progress);
    }
    if (!done && best_duration_ < unlimited) take_best();
  }
  for (LawPiece& p : pieces_) p.slow(slow_);
  result.cells += pieces_.size();
  result.law.append_all(pieces_);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::build(std::size_t first, std::size_t last, ProgressScope& progress) {
  GridOptions grid;
  grid.angle = path_.cartesian() ? options_.angle : kinematic_angle * options_.angle;
  grid.hermite = 1e-5;
  progress.half_of_rest();
  grid_.build(path_, first, last, {machine_, feed_}, grid, progress);
  build_grid(progress);
  soften();
  keep_ = all_cells;
  strict_caps_ = false;
}

template <int N, int M>
bool JerkSectionPlanner<N, M>::plan_whole(Start start, ProgressScope& progress) {
  pieces_.clear();
  const double duration = attempt(start, progress);
  if (slow_ < start.enough) {
    if (best_duration_ < duration) take_best();
    return true;
  }
  keep_if_best(duration);
  return false;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::keep_if_best(double duration) {
  if (!(duration < best_duration_)) return;
  best_duration_ = duration;
  best_slow_ = slow_;
  std::swap(best_, pieces_);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::take_best() {
  slow_ = best_slow_;
  std::swap(best_, pieces_);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::plan_under_ceilings(ProgressScope& progress) {
  divides_ = false;
  ceiling_.assign(grid_.cells.size() + 1, unlimited);
  for (int i = 0; i < max_lowerings; ++i) {
    pieces_.clear();
    const double duration = attempt(starts()[usual_start()], progress);
    keep_if_best(duration);
    if (slow_ < good_enough || !std::isfinite(duration)) break;
    lower_ceilings();
    rough(progress);
  }
  divides_ = true;
  ceiling_.clear();
}

template <int N, int M>
void JerkSectionPlanner<N, M>::lower_ceilings() {
  for (std::size_t c = 0; c < grid_.cells.size(); ++c) {
    double slow = std::sqrt(std::max(1.0, peaks_[c].velocity));
    for (std::size_t k = 0; k < M; ++k)
      slow = std::max({slow, std::sqrt(peaks_[c].acceleration[k]), std::cbrt(peaks_[c].jerk[k])});
    if (!(slow > bearable_slow)) continue;
    const double most = std::max(state_[c].b, state_[c + 1].b) / (slow * slow);
    for (const std::size_t i : {c, c + 1}) ceiling_[i] = std::min(ceiling_[i], most);
  }
}

template <int N, int M>
bool JerkSectionPlanner<N, M>::alone(std::size_t segment, JerkLimitedResult& result) {
  const Segment& line = path_[segment];
  if (!path_.linear(segment)) return false;
  const Station<N> p = path_.derivatives(segment, line.curve().begin());
  Limits limits = options_.path;
  limits.velocity = std::min(limits.velocity, feed_[segment]);
  for (std::size_t k = 0; k < N; ++k)
    if (const double rate = std::abs(p.d1[k]); rate > 0) limits.lower_to(machine_.axes[k], rate);
  if (!std::isfinite(limits.jerk)) return false;  // the acceleration would jump without a jerk limit
  append(result.law, straight_profile(line.length(), 0, 0, limits), line.s0(), segment);
  ++result.cells;
  return true;
}

template <int N, int M>
double JerkSectionPlanner<N, M>::attempt(Start start, ProgressScope& progress) {
  exit_ = {};
  sped_up_ = 1;
  certain_ = false;
  state_.resize(grid_.cells.size() + 1);
  const bool open = keep_ < grid_.cells.size();
  share_ = open ? open_share : full_share;
  guess(start, progress);
  build_problem(progress);
  if (start.mu > 0) improve(start.mu, progress);
  // A solver that diverged on a divided grid leaves the states that dividing interpolated, to 1e-9: next to a rest the
  // acceleration has to be exactly what the cell's law says.
  const std::size_t n = grid_.cells.size();
  const auto tie = [&](JerkNode& node, double a) {
    certain_ = certain_ && node.a == a;
    node.a = a;
  };
  if (n > 1 && !(state_[0].b > 0)) tie(state_[1], rest_tie(grid_.length(0)) * state_[1].b);
  if (n > 1 && !(state_[n].b > 0)) tie(state_[n - 1], -rest_tie(grid_.length(n - 1)) * state_[n - 1].b);
  certify(progress);
  return emit(progress);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::improve(double mu, ProgressScope& progress) {
  JerkSolverOptions solver;
  double reach = 3e-2;
  int division = 0, exact = 0;
  bool fresh = true, restarted = false;
  const bool cartesian = path_.cartesian();
  const auto divide = [&](double barrier) {
    ++division;
    refine(progress);
    build_problem(progress);
    fresh = true;
    mu = cartesian ? std::max(10 * barrier, 1e-2) : std::max(2 * barrier, 1e-3);
  };
  for (int round = 0;; ++round) {
    progress.half_of_rest();
    const bool open = round == 0 && keep_ < grid_.cells.size();
    solver.gap = reach;
    solver.violation = open ? open_violation : reach;
    if (round > 0) before_ = state_;
    certain_ = false;
    const JerkSolverResult r = solver_.solve(problem_, state_, mu, solver, progress);
    work_ += r.iterations * static_cast<double>(grid_.cells.size());
    if (round > 0 && !r.converged && !(r.violation < diverged)) {
      state_ = before_;
      if (restarted) return;
      restarted = true;
      mu = 1e-2;
      if (!wider_caps_) continue;
      strict_caps_ = true;  // the wider caps may be the cause
      build_problem(progress);
      fresh = true;
      continue;
    }
    if (!std::isfinite(r.duration)) return;
    if (round == 0) sped_up_ = speed_up();
    mu = 0;
    if (reach > 1e-3 && reach < 1e-2 && divides_ && division < options_.max_divisions && mark(progress)) {
      if (!cartesian) {  // divisions for both reasons at once
        measure(false, progress);
        mark_unresolved_cells();
      }
      divide(r.mu);
      continue;
    }
    if (open) {
      drop_braking_tail();
      share_ = full_share;
      build_problem(progress);
      mu = r.mu;
    }
    measure(false, progress);
    // An excess of a cell without middle rows does not reduce shares if the cell gets these rows.
    const bool accelerations = !fresh;
    if (fresh) build_middle_rows(true, progress);
    fresh = false;
    // The rest slows the section by its square root (v², a) or cube root (j).
    const auto bearable = [&] { return std::max({worst_.v, worst_.a, worst_.j}) < 1 + 4 * options_.gap; };
    if (reach <= options_.gap) {
      if (round >= options_.max_rounds) break;
      if (bearable()) {
        if (cartesian || exact == exact_rounds) break;
        ++exact;
        measure(true, progress);
        if (bearable()) break;
      }
    }
    tighten(cartesian || reach > options_.gap ? 1.05 : late_tightening, accelerations);
    division_.clear();
    if (divides_ && division < (cartesian ? 4 : 1) * options_.max_divisions && mark_unresolved_cells()) {
      divide(r.mu);
      reach = 3e-3;
      continue;
    }
    reach = std::max(0.1 * reach, options_.gap);
  }
}

template <int N, int M>
double JerkSectionPlanner<N, M>::emit(ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  slow_ = 1;
  if (worst_.v > 1) slow_ = std::max(slow_, std::sqrt(worst_.v));
  if (worst_.a > 1) slow_ = std::max(slow_, std::sqrt(worst_.a));
  if (worst_.j > 1) slow_ = std::max(slow_, std::cbrt(worst_.j));
  if (slow_ > 1) slow_ *= 1 + 1e-12;
  double total = 0;
  bool sound = std::isfinite(slow_);
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    const double h = grid_.length(c);
    LawPiece p = jerk_piece(state_[c], state_[c + 1], h);
    sound = sound && p.duration > 0 && std::abs(p.at(p.duration).s - h) <= 1e-9 * h;
    for (const double t : turning_points(p))
      if (t > rest * p.duration && t < (1 - rest) * p.duration) sound = sound && p.at(t).v > 0;
    p.segment = grid_.cells[c].segment;
    p.s = path_[p.segment].s0() + grid_.left(c).s;
    p.s_end = path_[p.segment].s0() + grid_.right(c).s;
    total += p.duration;
    pieces_.push_back(p);
  }
  if (!sound || !std::isfinite(total)) slow_ = unlimited;
  return std::isfinite(slow_) ? total * slow_ : unlimited;
}

}  // namespace bahnwerk
