#pragma once
/// Lays the grid of a section, a first law on it, and the rows of its problem.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/section.hpp"

namespace bahnwerk {

namespace {

/// A cell that lasts this part of A/J gets rows for the acceleration half-way.
constexpr double middle_from = 0.15, near_limit = 0.8;

/// A part that lasts so many times what parts should last is divided once more, through kinematics.
constexpr double long_part = 2;

/// A cell needs no nodes inside if the speed v is constant for this many times A/J + v/A before and behind it, and
/// takes at most this part of the limits of acceleration and jerk.
constexpr double steady_times = 3, steady_part = 0.75;

}  // namespace

template <int N, int M>
void JerkSectionPlanner<N, M>::caps(LargeVector<double>& cap, ProgressScope& progress) const {
  const std::size_t n = grid_.cells.size();
  cap.assign(n + 1, unlimited);
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    const double f = feed(c);
    for (const std::size_t e : {std::size_t{0}, std::size_t{1}}) {
      const Station<N>& s = e ? grid_.right(c) : grid_.left(c);
      double most = f * f;
      for (std::size_t k = 0; k < N; ++k) {
        const double t = s.d1[k] * s.d1[k] * limit_.inverse_velocity2[k];
        if (t * most > 1) most = 1 / t;
      }
      cap[c + e] = std::min(cap[c + e], most);
    }
    if (joint(c)) {
      cap[c] = std::min(cap[c], sections_.joint_cap[grid_.cells[c].segment]);

      for (std::size_t k = 0; k < N; ++k) {
        const double step = std::abs(grid_.left(c).d2[k] - grid_.right(c - 1).d2[k]) * limit_.inverse_jerk[k];
        if (step * cap[c] > machine_.cycle_time) cap[c] = machine_.cycle_time / step;
      }
    }
  }
  for (std::size_t i = 0; i < ceiling_.size(); ++i) cap[i] = std::min(cap[i], ceiling_[i]);
  if (!(entry_.b > 0)) cap[0] = 0;
  if (!(exit_.b > 0)) cap[n] = 0;
}

template <int N, int M>
double JerkSectionPlanner<N, M>::cell_cap(std::size_t c, bool at_end) const {
  const Station<N>&l = grid_.left(c), &r = grid_.right(c), &s = at_end ? r : l;
  const double f = feed(c), h = at_end ? l.s - r.s : r.s - l.s;
  double cap = f * f;
  for (std::size_t k = 0; k < N; ++k) {
    const double least = limit_.inverse_velocity2[k] * std::max(l.d1[k] * l.d1[k], r.d1[k] * r.d1[k]);
    if (least * cap <= 1) continue;
    const double t = s.d1[k] * s.d1[k] * limit_.inverse_velocity2[k];
    // φ = 1/t, φ′ = −2 φ h″/h′
    const double sloped = t > 0 ? (1 - (2.0 / 3) * h * s.d2[k] / s.d1[k]) / t : 0;
    cap = std::min(cap, std::max(sloped, 1 / least));
  }
  return cap;
}

template <int N, int M>
double JerkSectionPlanner<N, M>::steepest(const Station<N>& at, double b) const {
  double most = options_.path.acceleration;
  for (std::size_t k = 0; k < N; ++k) {
    const double d1 = std::abs(at.d1[k]), A = machine_.axes[k].acceleration + std::abs(at.d2[k]) * b;
    if (d1 * most > A) most = A / d1;
  }
  return most;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::rough(ProgressScope& progress) {
  caps(cap_, progress);
  rough_profile<N>(grid_, {machine_, feed_}, options_.path, cap_, rough_, progress);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::find_steady() {
  const std::size_t n = grid_.cells.size();
  const auto& b = rough_.b;
  double acceleration = options_.path.acceleration;
  for (std::size_t k = 0; k < N; ++k) acceleration = std::min(acceleration, machine_.axes[k].acceleration);
  const auto easy = [&](const Station<N>& at, double v2) {
    const double v3 = v2 * std::sqrt(v2);
    for (std::size_t k = 0; k < N; ++k)
      if (std::abs(at.d2[k]) * v2 * limit_.inverse_acceleration[k] > steady_part ||
          std::abs(at.d3[k]) * v3 * limit_.inverse_jerk[k] > steady_part)
        return false;
    return true;
  };
  steady_.assign(n, 0);
  double time = 0;  // s, time at constant speed so far
  const auto look = [&](std::size_t c) {
    const bool same = b[c] > 0 && b[c] == b[c + 1] && easy(grid_.left(c), b[c]) && easy(grid_.right(c), b[c]);
    const bool long_enough = time >= steady_times * (jerk_time_ + std::sqrt(b[c]) / acceleration);
    time = same ? time + rough_.duration[c] : 0;
    return same && long_enough;
  };
  for (std::size_t c = 0; c < n; ++c) steady_[c] = look(c);
  time = 0;
  for (std::size_t c = n; c-- > 0;) steady_[c] &= look(c);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::build_grid(ProgressScope& progress) {
  rough(progress);
  find_steady();
  const std::size_t n = grid_.cells.size();
  double total = 0;
  for (const double t : rough_.duration) total += t;
  division_.assign(n, {});
  longest_.clear();
  for (std::size_t c = 0; c < n; ++c) {
    // Through kinematics axes may run as evenly as along a straight segment: what turns little takes long.
    const bool straight = grid_.cells[c].straight || !path_.cartesian();
    const bool rest_left = c == 0, rest_right = c + 1 == n;
    const double t = rough_.duration[c];
    const double tau = std::min(std::max(jerk_time_ / 6, straight ? t / 40 : t), total / 40);
    int parts = steady_[c] ? 1 : static_cast<int>(std::clamp(std::ceil(t / tau), 1.0, 64.0));
    if (rest_left || rest_right) parts = std::max(parts, 4);
    division_[c] = {static_cast<std::uint16_t>(parts), rest_left && rest_right ? Spread::both
                                                       : rest_left             ? Spread::from_rest
                                                       : rest_right            ? Spread::to_rest
                                                                               : Spread::even};
    longest_.insert(longest_.end(), static_cast<std::size_t>(parts), steady_[c] ? unlimited : long_part * tau);
  }
  divide<N>(grid_, path_, division_, progress);
  rough(progress);
  if (!path_.cartesian() && mark_long()) {
    divide<N>(grid_, path_, division_, progress);
    rough(progress);
  }
}

template <int N, int M>
bool JerkSectionPlanner<N, M>::mark_long() {
  constexpr double most = 16;
  const std::size_t n = grid_.cells.size();
  division_.assign(n, {});
  bool any = false;
  for (std::size_t c = 1; c + 1 < n; ++c) {
    const double t = rough_.duration[c];
    if (!(t > longest_[c])) continue;
    division_[c].parts = static_cast<std::uint16_t>(std::min(std::ceil(long_part * t / longest_[c]), most));
    any = true;
  }
  return any;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::soften() {
  find_steady();
  double total = 0, cells = 0;
  for (std::size_t c = 0; c < grid_.cells.size(); ++c)
    if (steady_[c] == 0) total += rough_.duration[c], cells += 1;
  const double mean = total / cells;  // cells > 0: those at both ends are never steady
  soft_ = limit_;
  for (std::size_t k = 0; k < M; ++k)
    soft_.inverse_jerk[k] = std::max(limit_.inverse_jerk[k], 0.125 * mean * limit_.inverse_acceleration[k]);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::guess(Start start, ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  const bool smoothed = start.smoothing != Smoothing::none;
  if (smoothed) smooth<N>(grid_, 2 * jerk_time_, start.smoothing, rough_, progress);
  const auto& b = smoothed ? rough_.smooth_b : rough_.b;
  const double part = start.part;
  for (std::size_t i = 1; i < n; ++i) {
    const double l = grid_.length(i - 1), r = grid_.length(i);
    state_[i].b = part * b[i];
    state_[i].a = 0.5 * part * ((b[i] - b[i - 1]) * r / l + (b[i + 1] - b[i]) * l / r) / (l + r);
  }
  // Next to a short cell a long one may find accelerations that no law of its length can have: with (a₁ − a₂) h/3 ≤ −m²
  // it has no duration.
  for (std::size_t i = 1; i < n; ++i)
    for (const std::size_t c : {i - 1, i}) {
      const std::size_t other = c < i ? i - 1 : i + 1;
      const double end = other > 0 && other < n ? part * b[other] : 0;
      const double mean = 0.5 * (std::sqrt(state_[i].b) + std::sqrt(end)), most = 0.75 * mean * mean / grid_.length(c);
      state_[i].a = std::clamp(state_[i].a, -most, most);
    }
  state_[0] = entry_;
  state_[n] = {};
  blend_previous_window();
  if (part > 0) return;
  double L = 0, s = 0;
  for (std::size_t c = 0; c < n; ++c) L += grid_.length(c);
  for (std::size_t i = 1; i < n; ++i) {
    s += grid_.length(i - 1);
    const double x = s * (L - s) / L, root = std::cbrt(x);
    state_[i] = {x * root, (2.0 / 3) * root * (L - 2 * s) / L};
  }
  state_[1].a = rest_tie(grid_.length(0)) * state_[1].b;
  state_[n - 1].a = -rest_tie(grid_.length(n - 1)) * state_[n - 1].b;
}

template <int N, int M>
double JerkSectionPlanner<N, M>::needle_part(std::size_t c) const {
  if (!grid_.cells[c].any_way) return 1;
  double along = 0, least = 0;
  for (std::size_t k = 0; k < N; ++k) {
    along = std::max(along, std::abs(grid_.left(c).d1[k]) * limit_.inverse_jerk[k]);
    least = std::max(least, limit_.inverse_jerk[k]);
  }
  return 0.125 * along / least;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::build_problem(ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  caps(cap_, progress);
  problem_.inverse_jerk = soft_.inverse_jerk;
  problem_.inverse_cap.resize(n + 1);
  problem_.cap_reach.resize(n + 1);
  wider_caps_ = false;
  for (std::size_t i = 1; i < n; ++i)
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t c = i - 1 + side;
      const double cell = cell_cap(c, side == 0), reach = (2.0 / 3) * grid_.length(c);
      problem_.inverse_cap[i][side] = 1 / (share_ * std::min(cap_[i], cell));
      problem_.cap_reach[i][side] = reach;
      if (!(cell > cap_[i]) || !ceiling_.empty() || strict_caps_) continue;
      // Where the node's own cap is lower than the cell's, the inner coefficient has to satisfy only the cell's. With
      // this reach it does, since no law has a larger acceleration there: it may leave a slow segment accelerating.
      wider_caps_ = true;
      const Station<N>& at = side == 0 ? grid_.right(c) : grid_.left(c);
      problem_.cap_reach[i][side] = std::max(0.0, reach - (cell - cap_[i]) / steepest(at, cap_[i]));
    }
  problem_.stations.clear();
  problem_.stations.reserve(grid_.stations.size());
  for (const auto& s : grid_.stations) problem_.stations.push_back(rows_of(s));
  problem_.cells.resize(n);
  problem_.nodes.clear();
  problem_.nodes.reserve(n);
  problem_.middles.clear();
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    auto& cell = problem_.cells[c];
    cell.h = grid_.length(c);
    cell.station = grid_.cells[c].station;
    for (auto& share : cell.share) share.fill(share_ * needle_part(c));
    const JerkStation<M>& s = problem_.stations[cell.station];
    if (c > 0) {
      add_node(c, s, limit_.inverse_acceleration);
      if (joint(c)) {
        const JerkStation<M>& before = problem_.stations[problem_.cells[c - 1].station + 1];
        add_node(c, before, limit_.inverse_acceleration);
        JerkStation<M> step;
        std::array<double, M> inverse{};
        for (std::size_t k = 0; k < N; ++k) {
          step.d1[k] = s.d1[k] - before.d1[k];
          step.d2[k] = s.d2[k] - before.d2[k];
          inverse[k] = limit_.inverse_jerk[k] / machine_.cycle_time;
        }
        add_node(c, step, inverse);
      }
    }
  }
  build_middle_rows(false, progress);
  look_half_way(progress);
}

template <int N, int M>
void JerkSectionPlanner<N, M>::build_middle_rows(bool looked, ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  problem_.middles.clear();
  const auto near = [&](std::size_t c) {
    for (const double a : peaks_[c].acceleration)
      if (a > near_limit) return true;
    return false;
  };
  const auto near_any = [&](std::size_t c) { return near(c) || (c > 0 && near(c - 1)) || (c + 1 < n && near(c + 1)); };
  for (std::size_t c = entry_.b > 0 ? 0 : 1; c < (exit_.b > 0 ? n : n - 1); ++c) {
    progress(c, n);
    if (duration(c) < middle_from * shortest_jerk_time_ && !(looked && near_any(c))) continue;
    const JerkStation<M>&s = problem_.stations[problem_.cells[c].station],
          &r = problem_.stations[problem_.cells[c].station + 1];
    const double h = problem_.cells[c].h;
    MiddleRows<M> m;
    m.cell = c;
    m.share.fill(share_);
    for (std::size_t k = 0; k < M; ++k) {
      const double i = limit_.inverse_acceleration[k];
      m.d1[k] = (0.5 * (s.d1[k] + r.d1[k]) + h * 0.125 * (s.d2[k] - r.d2[k])) * i;
      m.d2[k] = (0.25 * (s.d2[k] + r.d2[k]) + h * 0.0625 * (s.d3[k] - r.d3[k])) * i;
    }
    problem_.middles.push_back(m);
  }
}

template <int N, int M>
void JerkSectionPlanner<N, M>::add_node(std::size_t node, const JerkStation<M>& s,
                                        const std::array<double, M>& inverse) {
  NodeRows<M> rows;
  rows.node = node;
  rows.share.fill(share_);
  for (std::size_t k = 0; k < M; ++k) {
    rows.p[k] = s.d2[k] * inverse[k];
    rows.q[k] = s.d1[k] * inverse[k];
  }
  problem_.nodes.push_back(rows);
}

}  // namespace bahnwerk
