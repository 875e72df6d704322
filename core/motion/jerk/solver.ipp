#pragma once
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/solver.hpp"

namespace bahnwerk {

namespace {

/// Number of steps from a solution during which step lengths vary along the section. After these, step lengths are
/// equal everywhere, which is slower but converges. From a rough start, one with a barrier parameter larger than the
/// constant below, they are always equal: large steps of different lengths would violate the equations too much.
constexpr int uneven_steps = 10;
constexpr double rough_start = 5e-3;
/// Multipliers nearer zero would impede the next change of shares.
constexpr double least_mu = 0.3;

}  // namespace

template <int M>
void JerkSolver<M>::start(double mu) {
  // A slack starts at its room, but at a distance from the boundary.
  const Lane2 least = all(std::min(0.1, mu));
  scale_ = 0;
  for (std::size_t g = 0; g < groups_; ++g) {
    (*progress_)(lane_count * g, n_);
    const Ends x = ends(g);
    evaluate(g, x);
    Cells& cells = cells_[g];
    const Lane2 T = cells.weight = cells.law.T;
    cells.end[0].begin(x.outer, cells.law.j1, mu * T, least);
    cells.end[1].begin(x.inner, cells.law.j2, mu * T, least);
    scale_ += 2 * 2 * M * (T[0] + T[1]);
  }
  for (std::size_t i = 0; i <= groups_; ++i) {
    Nodes& nodes = nodes_[i];
    for (std::size_t half = 0; half < lane_count; ++half) {
      nodes.weight[half] = holds(i, half) ? 0.5 * (cell_weight(i - 1, half) + cell_weight(i, half)) : no_weight;
      scale_ += (2 * M + 2) * nodes.weight[half];
    }
    const Lane2 b = b_[i], a = a_[i], w = mu * nodes.weight;
    for (std::size_t k = 0; k < 2; ++k) nodes.capped[k].begin(1.0 - nodes.cap[k] * (b + nodes.slope[k] * a), w, least);
    nodes.rows.begin(b, a, w, least);
  }
  for (Joint& joint : joints_) {
    const std::size_t i = joint.node, half = joint.half;
    const double weight = nodes_[i].weight[half];
    joint.rows.begin(b_[i][half], a_[i][half], mu * weight, least[0]);
    scale_ += 2 * M * weight;
  }
  start_middles(mu);
  steps_.still(groups_);
}

/// Rows for cells' middles may come later than the others.
template <int M>
void JerkSolver<M>::start_middles(double mu) {
  for (Middles& set : middles_) {
    const Ends x = ends(set.cells);
    const Cells& cells = cells_[set.cells];
    for (std::size_t e = 0; e < lane_count; ++e)
      if (set.weight[e] != no_weight) set.weight[e] = cells.weight[e];
    const JerkMiddle<Lane2> m = jerk_middle(x.outer, x.inner, cells.law);
    set.rows.begin(x.outer.b + x.inner.b, m.g, mu * set.weight, all(std::min(0.1, mu)));
    scale_ += 2 * M * (set.weight[0] + set.weight[1]);
  }
}

template <int M>
JerkSolverResult JerkSolver<M>::solve(const JerkProblem<M>& problem, LargeVector<JerkNode>& x, double mu,
                                      const JerkSolverOptions& options, ProgressScope& progress) {
  if (problem.cells.size() < lane_count)  // no value is unknown
    return {.duration = jerk_piece(x[0], x[1], problem.cells[0].h).duration, .converged = true};
  problem_ = &problem;
  progress_ = &progress;
  adopt(x);
  const bool same_middles = adopt_middles();
  if (mu > 0) start(mu);
  if (mu == 0 && !same_middles) start_middles(gap_ / scale_);
  steps_.still(groups_);
  uneven_ = mu > rough_start ? 0 : uneven_steps;
  InteriorPointRule rule;
  rule.gap = rule.dual_residual = options.gap;
  rule.primal_residual = options.violation;
  rule.least_mu = least_mu;
  rule.max_iterations = options.iterations;
  const InteriorPointResult found = run_interior_point(*this, rule, mu > 0 ? mu : gap_ / scale_);
  for (std::size_t i = 0; i <= n_; ++i)
    x[i] = i <= groups_ ? JerkNode{b_[i][0], a_[i][0]} : JerkNode{b_[n_ - i][1], -a_[n_ - i][1]};
  return {found.iterations, duration_, found.gap, found.primal_residual, gap_ / scale_, found.converged};
}

template <int M>
InteriorPointFigures JerkSolver<M>::evaluate(double mu) {
  target_ = mu;
  assemble();
  direction();
  return {duration_, gap_, scale_, violation_};
}

template <int M>
StepLengths JerkSolver<M>::step(double mu) {
  steps_.fit(std::max(0.9, 1 - 10 * mu), uneven_ == 0, odd());
  if (uneven_ > 0) --uneven_;
  return {steps_.mean_primal, steps_.mean_dual};
}

/// The iterate is too near the boundary: it begins again from here.
template <int M>
void JerkSolver<M>::restart(double mu) {
  move_nodes();
  start(mu);
}

template <int M>
void JerkSolver<M>::add_share_costs(LargeVector<double>& cost) const {
  for (std::size_t g = 0; g < groups_; ++g)
    for (std::size_t half = 0; half < lane_count; ++half) {
      if (missing(g, half)) continue;
      double& c = cost[cell_of(g, half)];
      for (const auto& end : cells_[g].end)
        for (std::size_t k = 0; k < M; ++k)
          c += (end.rows[k].up.z[half] + end.rows[k].down.z[half]) * (1 - end.share[k][half]);
    }
}

}  // namespace bahnwerk
