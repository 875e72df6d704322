#pragma once
/// Divides cells in which the law switches.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/section.hpp"

namespace bahnwerk {

namespace {

/// Loss, in multiples of the Cartesian one, from which on a grid is divided through kinematics.
constexpr double kinematic_loss = 6;

}  // namespace

template <int N, int M>
double JerkSectionPlanner<N, M>::slack_ramp(std::size_t c, double change, double jerk) const {
  const PathLimits here = path_limits<N>(grid_.left(c), machine_, options_.path, unlimited);
  if (change < 0.2 * here.acceleration) return 0;
  double used = 0;  // used part of the jerk that the solver may use
  for (std::size_t k = 0; k < N; ++k)
    used = std::max(used, jerk * std::abs(grid_.left(c).d1[k]) * soft_.inverse_jerk[k]);
  if constexpr (M > N) used = std::max(used, jerk * soft_.inverse_jerk[N]);
  return std::min(1.0, change / here.acceleration) * std::max(0.0, 1 - 1.02 * used);
}

template <int N, int M>
bool JerkSectionPlanner<N, M>::mark(ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  const auto from_rest = [&](std::size_t c) { return c == 0 && !(entry_.b > 0); };
  const auto to_rest = [&](std::size_t c) { return c + 1 == n && !(exit_.b > 0); };
  loss_.assign(n, 0);
  double time = 0, total = 0;
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    const LawPiece p = jerk_piece(state_[c], state_[c + 1], grid_.length(c));
    const double T = p.duration, change = std::abs(p.snap) * T, end = p.a + T * (p.j + 0.5 * T * p.snap);
    const double jerk = std::max(std::abs(p.j), std::abs(p.j + T * p.snap)), a = std::max(std::abs(p.a), std::abs(end));
    const double v = std::sqrt(std::max(state_[c].b, state_[c + 1].b));
    time += T;
    if (jerk > 0) loss_[c] = change * T * T / 24 * std::max(T, std::min(a / jerk, jerk_time_)) / v;
    const bool rest = from_rest(c) || to_rest(c);
    if (rest || end > p.a) loss_[c] += (rest ? 0.5 : 0.125) * T * slack_ramp(c, std::abs(end - p.a), jerk);
  }
  // Wide cells, in which jerk inside exceeds that at the ends, lose as much by smaller shares as by switching.
  if (!path_.cartesian()) solver_.add_share_costs(loss_);
  for (const double l : loss_) total += l;
  const double bearable = (path_.cartesian() ? 1 : kinematic_loss) * options_.tolerance * time;
  if (total <= bearable) return false;
  std::size_t many = 0;
  for (const double l : loss_)
    if (l > bearable / static_cast<double>(n)) ++many;
  const double dear = bearable / static_cast<double>(many);
  // The loss of a cell falls with the square of its parts. Wide cells get as many parts as needed at once, so that the
  // law has to be found on one more grid, not on two.
  const auto parts = [&](double excess) -> std::uint16_t {
    if (path_.cartesian()) return 4;
    return static_cast<std::uint16_t>(std::clamp(std::ceil(std::sqrt(1.5 * excess)), 2.0, 8.0));
  };
  division_.assign(n, {});
  for (std::size_t c = 0; c < n; ++c) {
    if (loss_[c] <= 0.5 * dear) continue;
    division_[c].parts = parts(loss_[c] / dear);
    if (c > 0 && division_[c - 1].parts == 1) division_[c - 1].parts = 2;
    if (c + 1 < n && division_[c + 1].parts == 1) division_[c + 1].parts = 2;
  }
  if (from_rest(0)) division_[0].spread = Spread::from_rest;
  if (to_rest(n - 1)) division_[n - 1].spread = Spread::to_rest;
  return true;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::refine(ProgressScope& progress) {
  const LargeVector<GridCell> cells = grid_.cells;
  LargeVector<double> length(cells.size()), begin(cells.size()), ends(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    length[c] = grid_.length(c);
    begin[c] = grid_.left(c).s;
    ends[c] = grid_.right(c).s;
  }
  const LargeVector<JerkNode> old = state_;
  divide<N>(grid_, path_, division_, progress);
  state_.resize(grid_.cells.size() + 1);
  std::size_t c = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    progress(i, cells.size());
    const LawPiece law = jerk_piece(old[i], old[i + 1], length[i]);
    state_[c] = old[i];
    double t = 0;
    for (++c; c < grid_.cells.size() && grid_.cells[c].segment == cells[i].segment && grid_.left(c).s < ends[i]; ++c) {
      const double s = grid_.left(c).s - begin[i];
      if (t == 0) t = law.duration * (s / length[i]);
      for (int step = 0; step < 20; ++step) {
        const LawState x = law.at(t);
        const double next = std::clamp(t + (s - x.s) / std::max(x.v, 1e-3 * s / law.duration), 0.0, law.duration);
        if (std::abs(next - t) <= 1e-9 * law.duration) break;
        t = next;
      }
      const LawState x = law.at(t);
      state_[c] = {x.v * x.v, x.a};
    }
  }
  state_[c] = old.back();
}

}  // namespace bahnwerk
