#pragma once
/// A step of the interior-point method, in two sweeps. The sweep from the section's ends to its middle takes the last
/// step, assembles the linear system and eliminates. The sweep back to the ends finds the solution and the largest step
/// lengths.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/solver.hpp"

namespace bahnwerk {

namespace {

inline Lane2 along(const std::array<Lane2, 4>& q, Lane2 b1, Lane2 a1, Lane2 b2, Lane2 a2) {
  return q[0] * b1 + q[1] * a1 + q[2] * b2 + q[3] * a2;
}

}  // namespace

template <int M>
void JerkSolver<M>::move_nodes() {
  for (std::size_t i = 0; i <= groups_; ++i) {
    const Lane2 part = steps_.node_primal[i];
    b_[i] += part * db_[i];
    a_[i] += part * da_[i];
    v_[i] = root(b_[i]);
    w_[i] = 0.5 / v_[i];
  }
  for (std::size_t half = 0; half < lane_count; ++half)
    if (rests(half)) w_[0][half] = 0;
}

template <int M>
void JerkSolver<M>::evaluate(std::size_t g, const Ends& x) {
  Cells& cells = cells_[g];
  cells.law = jerk_cell(x.outer, x.inner, cells.h);
  for (std::size_t half = 0; g == 0 && half < lane_count; ++half)
    if (rests(half)) set(cells.law, half, rest_cell(b_[1][half], cells.h[half], 1));
  if (!missing(g, 1)) return;
  JerkCell none;
  none.T = no_weight;
  set(cells.law, 1, none);
}

template <int M>
NodeBlock<Lane2> JerkSolver<M>::assemble_nodes(std::size_t i, JerkTotals<Lane2>& totals) {
  Nodes& nodes = nodes_[i];
  const Lane2 b = b_[i], a = a_[i], w = w_[i];
  const JerkTarget<Lane2> target{target_ * nodes.weight, steps_.node_primal[i], steps_.node_dual[i]};
  NodeBlock<Lane2> block;
  // bb is the convex part of the duration's second derivative, 3 (h₁ + h₂)/(8 v⁵).
  const Lane2 w2 = w * w;
  block.bb = 12.0 * nodes.length * (w2 * w2 * w);
  for (std::size_t k = 0; k < 2; ++k) {
    Lane2 weight, y;
    const Lane2 p = nodes.cap[k], q = p * nodes.slope[k];
    nodes.capped[k].move(target.primal, target.dual);
    totals.count(nodes.capped[k], nodes.capped[k].weigh(1.0 - (p * b + q * a), target.mu, weight, y));
    block.add(weight, p, q, y);
  }
  nodes.rows.assemble(b, a, target, block, totals);
  return block;
}

template <int M>
CellMatrix<Lane2> JerkSolver<M>::assemble_cells(std::size_t g, std::size_t& next_middle, JerkTotals<Lane2>& totals) {
  Cells& cells = cells_[g];
  const Ends x = ends(g);
  evaluate(g, x);
  const JerkCellOf<Lane2>& law = cells.law;
  JerkTarget<Lane2> target{target_ * cells.weight, steps_.primal[g], steps_.dual[g]};
  auto K = CellMatrix<Lane2>::of_left(law.dj1, cells.end[0].assemble(x.outer, law.j1, target, totals),
                                      {-law.dT[0], -law.dT[1], -law.dT[2], -law.dT[3]});
  K.add_right(law.dj2, cells.end[1].assemble(x.inner, law.j2, target, totals));
  if (next_middle < middles_.size() && middles_[next_middle].cells == g) {
    Middles& set = middles_[next_middle++];
    const JerkMiddle<Lane2> m = jerk_middle(x.outer, x.inner, law);
    target.mu = target_ * set.weight;
    K.add_both(m.dg, set.rows.assemble(x.outer.b + x.inner.b, m, target, totals));
  }
  return K;
}

template <int M>
NodeBlock<Lane2> JerkSolver<M>::assemble_joint(Joint& joint, JerkTotals<double>& totals) {
  const std::size_t i = joint.node, half = joint.half;
  NodeBlock<double> block;
  const JerkTarget<double> target{target_ * nodes_[i].weight[half], steps_.node_primal[i][half],
                                  steps_.node_dual[i][half]};
  joint.rows.assemble(b_[i][half], a_[i][half], target, block, totals);
  NodeBlock<Lane2> blocks;
  set(blocks, half, block);
  return blocks;
}

template <int M>
void JerkSolver<M>::eliminate_first(const NodeBlock<Lane2>& now, const CellMatrix<Lane2>& K, NodeBlock<Lane2>& after) {
  for (std::size_t half = 0; half < lane_count; ++half) {
    const NodeBlock<double> block = lane(now, half);
    const CellMatrix<double> cell = lane(K, half);
    NodeBlock<double> rest = lane(after, half);
    set(elimination_[1], half,
        rests(half) ? eliminate_tied(block, rest_tie(cells_[0].h[half]), cell, rest)
                    : eliminate(block, block.bb, block.aa, cell, rest));
    set(after, half, rest);
  }
}

template <int M>
JerkNode JerkSolver<M>::meet(const NodeBlock<Lane2>& blocks) const {
  NodeBlock<double> first = lane(blocks, 0);
  const NodeBlock<double> second = lane(blocks, 1);
  first.add({second.bb, -second.ba, second.aa, second.rb, -second.ra});
  const CellMatrix<double> nothing;
  NodeBlock<double> none;
  const bool tied = groups_ == 1 && rests(0), tied_back = n_ - groups_ == 1 && rests(1);
  const Elimination<double> e = tied        ? eliminate_tied(first, rest_tie(cells_[0].h[0]), nothing, none)
                                : tied_back ? eliminate_tied(first, -rest_tie(cells_[0].h[1]), nothing, none)
                                            : eliminate(first, first.bb, first.aa, nothing, none);
  return {e.yb, e.ya};
}

template <int M>
void JerkSolver<M>::assemble() {
  move_nodes();
  std::size_t next_joint = 0, next_middle = 0;
  NodeBlock<Lane2> after;
  Lane2 before_bb{}, before_aa{};
  JerkTotals<Lane2> totals;
  JerkTotals<double> at_joints;
  Lane2 duration{};
  for (std::size_t g = 0; g < groups_; ++g) {
    (*progress_)(lane_count * g, n_);
    NodeBlock<Lane2> now = assemble_nodes(g, totals);
    const CellMatrix<Lane2> K = assemble_cells(g, next_middle, totals);
    duration += cells_[g].law.T;
    now.add({K.m00, K.m01, K.m11, K.r[0], K.r[1]});
    const Lane2 bb = now.bb + before_bb, aa = now.aa + before_aa;
    now.add(after);
    while (joint_at(g, next_joint)) now.add(assemble_joint(joints_[next_joint++], at_joints));
    after = {K.m22, K.m23, K.m33, K.r[2], K.r[3]};
    before_bb = K.m22;
    before_aa = K.m33;
    if (g == 1)
      eliminate_first(now, K, after);
    else if (g > 1)
      elimination_[g] = eliminate(now, bb, aa, K, after);
    if (missing(g, 1)) set(after, 1, lane(now, 1));  // the node in the middle stays
  }
  after.add(assemble_nodes(groups_, totals));
  while (joint_at(groups_, next_joint)) after.add(assemble_joint(joints_[next_joint++], at_joints));
  middle_ = meet(after);
  duration_ = duration[0] + duration[1];
  gap_ = totals.gap[0] + totals.gap[1] + at_joints.gap;
  violation_ = std::max({totals.violation[0], totals.violation[1], at_joints.violation});
}

template <int M>
JerkReach<Lane2> JerkSolver<M>::direct_cells(std::size_t g, std::size_t& next_middle) {
  Cells& cells = cells_[g];
  const Ends x = ends(g);
  const Lane2 b1 = db_[g], a1 = da_[g], b2 = db_[g + 1], a2 = da_[g + 1];
  const Lane2 mu = target_ * cells.weight, change = along(cells.law.dT, b1, a1, b2, a2);
  predicted_decrease_ += change[0] + change[1];
  // The step is limited so that no cell loses more than half of its duration, or of the root in its law (cell.hpp):
  // beyond that the linearisation is useless.
  JerkReach<Lane2> reach{-2.0 * magnitude(change) / cells.law.T, {}};
  const Lane2 mean = 0.5 * (x.outer.v + x.inner.v), h3 = (1.0 / 3) * cells.h;
  const Lane2 now = mean * mean + h3 * (x.outer.a - x.inner.a),
              fall = -mean * (x.outer.w * b1 + x.inner.w * b2) - h3 * (a1 - a2);
  Lane2 loss = 2.0 * fall / larger(now, jerk_cell_detail::min_root * mean * mean);
  for (std::size_t half = 0; half < lane_count; ++half)
    if ((g == 0 && rests(half)) || missing(g, half)) loss[half] = 0;
  reach.primal = smaller(reach.primal, -loss);
  cells.end[0].step(x.outer, b1, a1, along(cells.law.dj1, b1, a1, b2, a2), mu, reach);
  cells.end[1].step(x.inner, b2, a2, along(cells.law.dj2, b1, a1, b2, a2), mu, reach);
  if (next_middle > 0 && middles_[next_middle - 1].cells == g) {
    Middles& set = middles_[--next_middle];
    set.rows.step(b1 + b2, along(set.rows.gradient, b1, a1, b2, a2), target_ * set.weight, reach);
  }
  return reach;
}

template <int M>
JerkReach<Lane2> JerkSolver<M>::direct_nodes(std::size_t i, std::size_t& next_joint) {
  Nodes& nodes = nodes_[i];
  JerkReach<Lane2> reach;
  const Lane2 db = db_[i], da = da_[i], w = w_[i], mu = target_ * nodes.weight;
  for (std::size_t k = 0; k < 2; ++k) nodes.capped[k].step(nodes.cap[k] * (db + nodes.slope[k] * da), mu, reach);
  nodes.rows.step(db, da, mu, reach);
  // Speeds stay positive, and no node runs away on the strength of its linearisation.
  const Lane2 growth = 4.0 * w * w * db;
  reach.primal = smaller(reach.primal, smaller(growth * (1 / 0.8), growth * (-1 / 1.5)));
  for (; next_joint > 0 && joints_[next_joint - 1].node == i; --next_joint) {
    Joint& joint = joints_[next_joint - 1];
    const std::size_t half = joint.half;
    JerkReach<double> at_joint{reach.primal[half], reach.dual[half]};
    joint.rows.step(db[half], da[half], mu[half], at_joint);
    reach.primal[half] = at_joint.primal;
    reach.dual[half] = at_joint.dual;
  }
  return reach;
}

template <int M>
void JerkSolver<M>::direction() {
  std::size_t next_middle = middles_.size(), next_joint = joints_.size();
  predicted_decrease_ = 0;
  db_[groups_] = Lane2{middle_.b, odd() ? 0 : middle_.b};
  da_[groups_] = Lane2{middle_.a, odd() ? 0 : -middle_.a};
  // A node's rows count for the cell to the right of it: in the second half that is the outer one.
  const JerkReach<Lane2> middle = direct_nodes(groups_, next_joint);
  JerkReach<Lane2> inner{all(middle.primal[0]), all(middle.dual[0])};
  for (std::size_t g = groups_; g-- > 0;) {
    (*progress_)(n_ - lane_count * (g + 1) + odd(), n_);
    if (g > 0) elimination_[g].back(db_[g + 1], da_[g + 1], db_[g], da_[g]);
    if (missing(g, 1)) {
      db_[g][1] = middle_.b;
      da_[g][1] = -middle_.a;
    }
    JerkReach<Lane2> node = direct_nodes(g, next_joint);
    const JerkReach<Lane2> cell = direct_cells(g, next_middle);
    steps_.primal[g] = -smaller(cell.primal, Lane2{node.primal[0], inner.primal[1]});
    steps_.dual[g] = larger(cell.dual, Lane2{node.dual[0], inner.dual[1]});
    if (missing(g, 1)) {  // the node in the middle again
      node.primal = smaller(node.primal, inner.primal);
      node.dual = larger(node.dual, inner.dual);
    }
    inner = node;
  }
}

}  // namespace bahnwerk
