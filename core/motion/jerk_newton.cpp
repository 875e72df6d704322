/// One step of the interior-point method: forwards through the run the last step is taken, the linear system assembled
/// and eliminated, backwards its solution found and how much of it can be taken.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk_solver.hpp"

namespace bahnwerk {

namespace {

inline Twin along(const std::array<Twin, 4>& q, Twin b1, Twin a1, Twin b2, Twin a2) {
  return q[0] * b1 + q[1] * a1 + q[2] * b2 + q[3] * a2;
}

/// One cell's law into its lane.
inline void set(JerkCellOf<Twin>& laws, std::size_t lane, const JerkCell& law) {
  laws.T[lane] = law.T;
  laws.j1[lane] = law.j1;
  laws.j2[lane] = law.j2;
  for (std::size_t i = 0; i < 4; ++i) {
    laws.dT[i][lane] = law.dT[i];
    laws.dj1[i][lane] = law.dj1[i];
    laws.dj2[i][lane] = law.dj2[i];
  }
}

}  // namespace

template <int M>
void JerkSolver<M>::move_nodes() {
  for (std::size_t i = 0; i < twin * groups_; i += twin) {
    const Twin part = two(steps_.node_primal, i);
    const Twin b = two(b_, i) + part * two(db_, i), v = root(b);
    put(b_, i, b);
    put(a_, i, two(a_, i) + part * two(da_, i));
    put(v_, i, v);
    put(w_, i, 0.5 / v);
  }
  if (from_rest()) w_[0] = 0;
  for (std::size_t i = to_rest() ? n_ : n_ + 1; i < w_.size(); ++i) w_[i] = 0;
}

template <int M>
void JerkSolver<M>::evaluate(std::size_t g, const Ends& x) {
  Cells& cells = cells_[g];
  cells.law = jerk_cell(x.v1, x.w1, x.a1, x.v2, x.w2, x.a2, cells.h);
  if (g == 0 && from_rest()) set(cells.law, 0, rest_cell(b_[1], cells.h[0], 1));
  if (g + 1 < groups_) return;
  const std::size_t last = (n_ - 1) % twin;
  if (to_rest()) set(cells.law, last, rest_cell(b_[n_ - 1], cells.h[last], 0));
  JerkCell none;
  none.T = no_weight;
  for (std::size_t lane = last + 1; lane < twin; ++lane) set(cells.law, lane, none);
}

template <int M>
NodeBlock<Twin> JerkSolver<M>::assemble_nodes(std::size_t g, JerkTotals<Twin>& totals) {
  Nodes& nodes = nodes_[g];
  const std::size_t i = twin * g;
  const Twin b = two(b_, i), a = two(a_, i), w = two(w_, i), mu = target_ * nodes.weight;
  const Twin primal = two(steps_.node_primal, i), dual = two(steps_.node_dual, i);
  NodeBlock<Twin> block;
  // Of the duration's curvature the convex part, 3 (h₁ + h₂)/(8 v⁵).
  const Twin w2 = w * w;
  block.bb = 18.0 * (nodes.slope[1] - nodes.slope[0]) * (w2 * w2 * w);
  for (std::size_t k = 0; k < 2; ++k) {
    Twin weight, y;
    const Twin p = nodes.cap[k], q = p * nodes.slope[k];
    nodes.capped[k].move(primal, dual);
    nodes.capped[k].weigh(1.0 - (p * b + q * a), mu, weight, y);
    block.add(weight, p, q, y);
    totals.count(nodes.capped[k]);
  }
  nodes.rows.assemble(b, a, mu, primal, dual, block, totals);
  return block;
}

template <int M>
CellMatrix<Twin> JerkSolver<M>::assemble_cells(std::size_t g, std::size_t& next_middle, JerkTotals<Twin>& totals) {
  Cells& cells = cells_[g];
  const Ends x = ends(g);
  evaluate(g, x);
  const JerkCellOf<Twin>& law = cells.law;
  const Twin mu = target_ * cells.weight, primal = two(steps_.primal, twin * g), dual = two(steps_.dual, twin * g);
  CellMatrix<Twin> K;
  for (std::size_t i = 0; i < 4; ++i) K.r[i] = -law.dT[i];
  K.add_left(law.dj1, cells.end[0].assemble(x.b1, x.v1, x.w1, x.a1, law.j1, mu, primal, dual, totals));
  K.add_right(law.dj2, cells.end[1].assemble(x.b2, x.v2, x.w2, x.a2, law.j2, mu, primal, dual, totals));
  if (next_middle < middles_.size() && middles_[next_middle].cells == g) {
    Middles& set = middles_[next_middle++];
    const JerkMiddle<Twin> m = jerk_middle(x.v1, x.w1, x.a1, x.v2, x.w2, x.a2, law);
    K.add_both(m.dg, set.rows.assemble(x.b1 + x.b2, m, target_ * set.weight, primal, dual, totals));
  }
  return K;
}

template <int M>
void JerkSolver<M>::assemble(PlanningPulse& pulse) {
  move_nodes();
  std::size_t next_joint = 0, next_middle = 0;
  NodeBlock<double> now, after;
  JerkTotals<Twin> totals;
  JerkTotals<double> at_joints;
  Twin duration{};
  for (std::size_t g = 0; g < groups_; ++g) {
    pulse(twin * g, n_);
    const NodeBlock<Twin> blocks = assemble_nodes(g, totals);
    const CellMatrix<Twin> Ks = assemble_cells(g, next_middle, totals);
    duration += cells_[g].law.T;
    for (std::size_t e = 0; e < twin && twin * g + e < n_; ++e) {
      const std::size_t c = twin * g + e;
      const CellMatrix<double> K = lane(Ks, e);
      now = after;
      after = {K.m22, K.m23, K.m33, K.r[2], K.r[3]};
      if (c == 0) continue;
      now.bb += blocks.bb[e] + K.m00;
      now.ba += blocks.ba[e] + K.m01;
      now.aa += blocks.aa[e] + K.m11;
      now.rb += blocks.rb[e] + K.r[0];
      now.ra += blocks.ra[e] + K.r[1];
      for (; next_joint < joints_.size() && joints_[next_joint].node == c; ++next_joint)
        joints_[next_joint].rows.assemble(b_[c], a_[c], target_ * weight(c), steps_.node_primal[c], steps_.node_dual[c],
                                          now, at_joints);
      if (c == 1 && from_rest())
        elimination_[c] = eliminate_tied(now, rest_tie(cells_[0].h[0]), K, after);
      else if (c + 1 == n_ && to_rest())
        elimination_[c] = eliminate_tied(now, -rest_tie(cells_[g].h[e]), K, after);
      else
        elimination_[c] = eliminate(now, K, after);
    }
  }
  duration_ = duration[0] + duration[1];
  gap_ = totals.gap[0] + totals.gap[1] + at_joints.gap;
  violation_ = std::max({totals.violation[0], totals.violation[1], at_joints.violation});
}

template <int M>
void JerkSolver<M>::direct_cells(std::size_t g, std::size_t& next_middle, Twin& primal, Twin& dual) {
  Cells& cells = cells_[g];
  const Ends x = ends(g);
  const std::size_t i = twin * g;
  const Twin b1 = two(db_, i), a1 = two(da_, i), b2 = two(db_, i + 1), a2 = two(da_, i + 1);
  const Twin mu = target_ * cells.weight, change = along(cells.law.dT, b1, a1, b2, a2);
  promise_ += change[0] + change[1];
  // No cell may leave the range in which its linearisation means something: of its duration, and of the root in its
  // law (jerk_cell.hpp), it loses no more than half.
  primal = 2.0 * magnitude(change) / cells.law.T;
  const Twin mean = 0.5 * (x.v1 + x.v2), h3 = (1.0 / 3) * cells.h;
  const Twin now = mean * mean + h3 * (x.a1 - x.a2), fall = -mean * (x.w1 * b1 + x.w2 * b2) - h3 * (a1 - a2);
  Twin loss = 2.0 * fall / larger(now, jerk_cell_detail::least_root * mean * mean);
  if (g == 0 && from_rest()) loss[0] = 0;
  if (g + 1 == groups_)
    for (std::size_t lane = (n_ - 1) % twin + (to_rest() ? 0 : 1); lane < twin; ++lane) loss[lane] = 0;
  primal = larger(primal, loss);
  cells.end[0].step(x.v1, x.w1, x.a1, along(cells.law.dj1, b1, a1, b2, a2), b1, a1, mu, primal, dual);
  cells.end[1].step(x.v2, x.w2, x.a2, along(cells.law.dj2, b1, a1, b2, a2), b2, a2, mu, primal, dual);
  if (next_middle == 0 || middles_[next_middle - 1].cells != g) return;
  Middles& set = middles_[--next_middle];
  set.rows.step(b1 + b2, along(set.rows.gradient, b1, a1, b2, a2), target_ * set.weight, primal, dual);
}

template <int M>
void JerkSolver<M>::direct_nodes(std::size_t g, Twin& primal, Twin& dual) {
  Nodes& nodes = nodes_[g];
  const std::size_t i = twin * g;
  const Twin db = two(db_, i), da = two(da_, i), w = two(w_, i), mu = target_ * nodes.weight;
  for (std::size_t k = 0; k < 2; ++k) nodes.capped[k].step(nodes.cap[k] * (db + nodes.slope[k] * da), mu, primal, dual);
  nodes.rows.step(db, da, mu, primal, dual);
  // Speeds stay positive, and no node runs away on the strength of its linearisation.
  const Twin growth = 4.0 * w * w * db;
  primal = larger(primal, larger(growth * (-1 / 0.8), growth * (1 / 1.5)));
}

template <int M>
void JerkSolver<M>::direction(PlanningPulse& pulse) {
  std::size_t next_middle = middles_.size(), next_joint = joints_.size();
  promise_ = 0;
  db_[n_] = da_[n_] = 0;
  for (std::size_t g = groups_; g-- > 0;) {
    pulse(n_ - 1 - twin * g, n_);
    for (std::size_t c = std::min(twin * g + twin, n_); c-- > std::max(twin * g, std::size_t{1});) {
      const JerkNode d = elimination_[c].back({db_[c + 1], da_[c + 1]});
      db_[c] = d.b;
      da_[c] = d.a;
    }
    Twin primal, dual{};
    direct_cells(g, next_middle, primal, dual);
    direct_nodes(g, primal, dual);
    for (; next_joint > 0 && joints_[next_joint - 1].node >= twin * g; --next_joint) {
      Joint& joint = joints_[next_joint - 1];
      const std::size_t e = joint.node % twin;
      double joint_primal = primal[e], joint_dual = dual[e];
      joint.rows.step(db_[joint.node], da_[joint.node], target_ * weight(joint.node), joint_primal, joint_dual);
      primal[e] = joint_primal;
      dual[e] = joint_dual;
    }
    put(steps_.primal, twin * g, primal);
    put(steps_.dual, twin * g, dual);
  }
}

template void JerkSolver<2>::move_nodes();
template void JerkSolver<2>::evaluate(std::size_t, const Ends&);
template NodeBlock<Twin> JerkSolver<2>::assemble_nodes(std::size_t, JerkTotals<Twin>&);
template CellMatrix<Twin> JerkSolver<2>::assemble_cells(std::size_t, std::size_t&, JerkTotals<Twin>&);
template void JerkSolver<2>::assemble(PlanningPulse&);
template void JerkSolver<2>::direct_cells(std::size_t, std::size_t&, Twin&, Twin&);
template void JerkSolver<2>::direct_nodes(std::size_t, Twin&, Twin&);
template void JerkSolver<2>::direction(PlanningPulse&);
template void JerkSolver<3>::move_nodes();
template void JerkSolver<3>::evaluate(std::size_t, const Ends&);
template NodeBlock<Twin> JerkSolver<3>::assemble_nodes(std::size_t, JerkTotals<Twin>&);
template CellMatrix<Twin> JerkSolver<3>::assemble_cells(std::size_t, std::size_t&, JerkTotals<Twin>&);
template void JerkSolver<3>::assemble(PlanningPulse&);
template void JerkSolver<3>::direct_cells(std::size_t, std::size_t&, Twin&, Twin&);
template void JerkSolver<3>::direct_nodes(std::size_t, Twin&, Twin&);
template void JerkSolver<3>::direction(PlanningPulse&);
template void JerkSolver<4>::move_nodes();
template void JerkSolver<4>::evaluate(std::size_t, const Ends&);
template NodeBlock<Twin> JerkSolver<4>::assemble_nodes(std::size_t, JerkTotals<Twin>&);
template CellMatrix<Twin> JerkSolver<4>::assemble_cells(std::size_t, std::size_t&, JerkTotals<Twin>&);
template void JerkSolver<4>::assemble(PlanningPulse&);
template void JerkSolver<4>::direct_cells(std::size_t, std::size_t&, Twin&, Twin&);
template void JerkSolver<4>::direct_nodes(std::size_t, Twin&, Twin&);
template void JerkSolver<4>::direction(PlanningPulse&);

}  // namespace bahnwerk
