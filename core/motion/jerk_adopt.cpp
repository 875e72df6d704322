/// Brings a JerkProblem into the form that the interior-point method calculates with: two cells, or nodes, at once.
#include <cmath>

#include "core/motion/jerk_solver.hpp"

namespace bahnwerk {

template <int M>
void JerkSolver<M>::adopt(const LargeVector<JerkNode>& x) {
  n_ = problem_->cells.size();
  groups_ = (n_ + twin - 1) / twin;
  const std::size_t size = twin * groups_ + twin;
  for (auto* values : {&b_, &a_, &v_, &w_, &db_, &da_}) values->assign(size, 0);
  for (std::size_t i = 0; i <= n_; ++i) {
    b_[i] = x[i].b;
    a_[i] = x[i].a;
  }
  if (from_rest()) a_[1] = rest_tie(problem_->cells[0].h) * b_[1];
  if (to_rest()) a_[n_ - 1] = -rest_tie(problem_->cells[n_ - 1].h) * b_[n_ - 1];
  for (std::size_t i = 0; i <= n_; ++i) {
    v_[i] = std::sqrt(b_[i]);
    w_[i] = b_[i] > 0 ? 0.5 / v_[i] : 0;
  }
  adopt_cells();
  adopt_nodes();
}

template <int M>
void JerkSolver<M>::adopt_cells() {
  const auto& p = *problem_;
  cells_.resize(groups_);
  elimination_.resize(n_ + 1);
  for (std::size_t c = 0; c < twin * groups_; ++c) {
    Cells& cells = cells_[c / twin];
    const std::size_t e = c % twin;
    const bool real = c < n_;
    const auto& cell = p.cells[real ? c : n_ - 1];
    cells.h[e] = cell.h;
    for (std::size_t k = 0; k < M; ++k) {
      const double scale = real ? p.inverse_jerk[k] : 0;
      for (std::size_t end = 0; end < 2; ++end) {
        const JerkStation<M>& s = p.stations[cell.station + end];
        auto& rows = cells.end[end];
        rows.d1[k][e] = scale * s.d1[k];
        rows.d2[k][e] = 3 * scale * s.d2[k];
        rows.d3[k][e] = scale * s.d3[k];
        rows.share[k][e] = cell.share[end][k];
      }
    }
  }
}

template <int M>
void JerkSolver<M>::adopt_nodes() {
  const auto& p = *problem_;
  nodes_.resize(groups_);
  std::size_t next = 0, joints = 0;
  for (std::size_t i = 0; i < twin * groups_; ++i) {
    Nodes& nodes = nodes_[i / twin];
    const std::size_t e = i % twin;
    const bool inner = i > 0 && i < n_;
    for (std::size_t k = 0; k < 2; ++k) {
      nodes.cap[k][e] = inner ? p.inverse_cap[i][k] : 0;
      nodes.slope[k][e] = inner ? (k == 0 ? -(2.0 / 3) * p.cells[i - 1].h : (2.0 / 3) * p.cells[i].h) : 0;
    }
    const bool any = inner && next < p.nodes.size() && p.nodes[next].node == i;
    for (std::size_t k = 0; k < M; ++k) {
      nodes.rows.p[k][e] = any ? p.nodes[next].p[k] : 0;
      nodes.rows.q[k][e] = any ? p.nodes[next].q[k] : 0;
      nodes.rows.share[k][e] = any ? p.nodes[next].share[k] : 1;
    }
    if (any) ++next;
    for (; next < p.nodes.size() && p.nodes[next].node == i; ++next, ++joints) {
      if (joints == joints_.size()) joints_.emplace_back();
      Joint& joint = joints_[joints];
      joint.node = i;
      joint.rows.p = p.nodes[next].p;
      joint.rows.q = p.nodes[next].q;
      joint.rows.share = p.nodes[next].share;
    }
  }
  joints_.resize(joints);
}

template <int M>
bool JerkSolver<M>::adopt_middles() {
  const auto& p = *problem_;
  bool same = posed_middles_.size() == p.middles.size();
  for (std::size_t i = 0; same && i < p.middles.size(); ++i) same = posed_middles_[i] == p.middles[i].cell;
  if (!same) {
    posed_middles_.clear();
    middles_.clear();
    for (const MiddleRows<M>& set : p.middles) {
      posed_middles_.push_back(set.cell);
      if (middles_.empty() || middles_.back().cells != set.cell / twin) {
        Middles none{};
        none.cells = set.cell / twin;
        none.weight = all(no_weight);
        none.rows.share.fill(all(1));
        middles_.push_back(none);
      }
      middles_.back().weight[set.cell % twin] = 1;
    }
  }
  std::size_t at = 0;
  for (const MiddleRows<M>& set : p.middles) {
    while (middles_[at].cells != set.cell / twin) ++at;
    auto& rows = middles_[at].rows;
    const std::size_t e = set.cell % twin;
    for (std::size_t k = 0; k < M; ++k) {
      rows.d1[k][e] = set.d1[k];
      rows.d2[k][e] = set.d2[k];
      rows.share[k][e] = set.share[k];
    }
  }
  return same;
}

template void JerkSolver<2>::adopt(const LargeVector<JerkNode>&);
template void JerkSolver<2>::adopt_nodes();
template void JerkSolver<2>::adopt_cells();
template bool JerkSolver<2>::adopt_middles();
template void JerkSolver<3>::adopt(const LargeVector<JerkNode>&);
template void JerkSolver<3>::adopt_nodes();
template void JerkSolver<3>::adopt_cells();
template bool JerkSolver<3>::adopt_middles();
template void JerkSolver<4>::adopt(const LargeVector<JerkNode>&);
template void JerkSolver<4>::adopt_nodes();
template void JerkSolver<4>::adopt_cells();
template bool JerkSolver<4>::adopt_middles();

}  // namespace bahnwerk
