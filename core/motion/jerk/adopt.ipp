#pragma once
/// Brings a JerkProblem into the form that the interior-point method calculates with: both halves of the section side
/// by side, from its ends inwards, the second one backwards in time.
#include <cmath>

#include "core/motion/jerk/solver.hpp"

namespace bahnwerk {

namespace {

/// Sign of quantities that are odd in time.
constexpr double sign(std::size_t half) { return half == 0 ? 1 : -1; }

}  // namespace

template <int M>
void JerkSolver<M>::adopt(const LargeVector<JerkNode>& x) {
  n_ = problem_->cells.size();
  groups_ = (n_ + lane_count - 1) / lane_count;
  const bool from_rest = !(x[0].b > 0), to_rest = !(x[n_].b > 0);
  for (auto* values : {&b_, &a_, &v_, &w_, &db_, &da_}) values->assign(groups_ + 1, Lane2{});
  for (std::size_t i = 0; i <= groups_; ++i)
    for (std::size_t half = 0; half < lane_count; ++half) {
      const std::size_t node = node_of(i, half);
      const double b = x[node].b;
      double a = x[node].a;
      if (node == 1 && from_rest) a = rest_tie(problem_->cells[0].h) * b;
      if (node == n_ - 1 && to_rest) a = -rest_tie(problem_->cells[n_ - 1].h) * b;
      b_[i][half] = b;
      a_[i][half] = sign(half) * a;
      v_[i][half] = std::sqrt(b);
      w_[i][half] = b > 0 ? 0.5 / std::sqrt(b) : 0;
    }
  adopt_cells();
  adopt_nodes();
}

template <int M>
void JerkSolver<M>::adopt_cells() {
  const auto& p = *problem_;
  cells_.resize(groups_);
  elimination_.resize(groups_);
  for (std::size_t g = 0; g < groups_; ++g)
    for (std::size_t half = 0; half < lane_count; ++half) {
      Cells& cells = cells_[g];
      const auto& cell = p.cells[cell_of(g, half)];
      cells.h[half] = cell.h;
      for (std::size_t k = 0; k < M; ++k) {
        const double scale = missing(g, half) ? 0 : p.inverse_jerk[k];
        for (std::size_t end = 0; end < 2; ++end) {
          const std::size_t side = half == 0 ? end : 1 - end;
          const JerkStation<M>& s = p.stations[cell.station + side];
          auto& rows = cells.end[end];
          rows.d1[k][half] = scale * s.d1[k];
          rows.d2[k][half] = sign(half) * 3 * scale * s.d2[k];
          rows.d3[k][half] = scale * s.d3[k];
          rows.share[k][half] = cell.share[side][k];
        }
      }
    }
}

template <int M>
void JerkSolver<M>::adopt_nodes() {
  const auto& p = *problem_;
  nodes_.resize(groups_ + 1);
  std::size_t joints = 0;
  std::array<std::size_t, lane_count> next{0, p.nodes.size()};  // rows of the first half lie below, the second's above
  for (std::size_t i = 0; i <= groups_; ++i)
    for (std::size_t half = 0; half < lane_count; ++half) {
      Nodes& nodes = nodes_[i];
      const std::size_t node = node_of(i, half);
      const bool held = holds(i, half);
      for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t side = half == 0 ? k : 1 - k;
        nodes.cap[k][half] = held ? p.inverse_cap[node][side] : 0;
        nodes.slope[k][half] = held ? (k == 0 ? -1 : 1) * p.cap_reach[node][side] : 0;
      }
      nodes.length[half] = held ? p.cells[node - 1].h + p.cells[node].h : 0;
      std::size_t first = next[half], last = first;
      if (held && half == 0)
        for (; last < p.nodes.size() && p.nodes[last].node == node;) next[half] = ++last;
      if (held && half == 1)
        for (; first > 0 && p.nodes[first - 1].node == node;) next[half] = --first;
      const bool any = first < last;
      for (std::size_t k = 0; k < M; ++k) {
        nodes.rows.p[k][half] = any ? p.nodes[first].p[k] : 0;
        nodes.rows.q[k][half] = any ? sign(half) * p.nodes[first].q[k] : 0;
        nodes.rows.share[k][half] = any ? p.nodes[first].share[k] : 1;
      }
      for (++first; first < last; ++first, ++joints) {
        if (joints == joints_.size()) joints_.emplace_back();
        Joint& joint = joints_[joints];
        joint.node = i;
        joint.half = half;
        joint.rows.p = p.nodes[first].p;
        for (std::size_t k = 0; k < M; ++k) joint.rows.q[k] = sign(half) * p.nodes[first].q[k];
        joint.rows.share = p.nodes[first].share;
      }
    }
  joints_.resize(joints);
}

template <int M>
bool JerkSolver<M>::adopt_middles() {
  const auto& p = *problem_;
  bool same = prepared_cells_ == n_ && prepared_middles_.size() == p.middles.size();
  prepared_cells_ = n_;
  for (std::size_t i = 0; same && i < p.middles.size(); ++i) same = prepared_middles_[i] == p.middles[i].cell;
  if (!same) {
    prepared_middles_.clear();
    middles_.clear();
    for (const MiddleRows<M>& set : p.middles) prepared_middles_.push_back(set.cell);
  }
  std::size_t first = 0, last = p.middles.size(), at = 0;
  for (; first < last; ++at) {
    const std::size_t from_left = p.middles[first].cell, from_right = n_ - 1 - p.middles[last - 1].cell;
    const std::size_t g = std::min(from_left, from_right);
    if (!same) {
      Middles none{};
      none.cells = g;
      none.weight = all(no_weight);
      none.rows.share.fill(all(1));
      middles_.push_back(none);
    }
    if (from_left == g) take_middle(p.middles[first++], 0, middles_[at]);
    if (from_right == g && first < last) take_middle(p.middles[--last], 1, middles_[at]);
  }
  return same;
}

template <int M>
void JerkSolver<M>::take_middle(const MiddleRows<M>& rows, std::size_t half, Middles& to) {
  if (to.weight[half] == no_weight) to.weight[half] = 1;
  for (std::size_t k = 0; k < M; ++k) {
    to.rows.d1[k][half] = sign(half) * rows.d1[k];
    to.rows.d2[k][half] = rows.d2[k];
    to.rows.share[k][half] = rows.share[k];
  }
}

}  // namespace bahnwerk
