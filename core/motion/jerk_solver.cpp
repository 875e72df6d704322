#include "core/motion/jerk_solver.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

namespace {

constexpr double stuck_step = 0.05;
constexpr int stuck_steps = 3;
/// The gap is driven to no less than this part of what is asked for.
constexpr double least_gap = 0.3;
/// On from a solution, steps differ along the run; after so many they are the same everywhere: slower, but nothing in
/// the way of convergence. From a rough start they always are: large steps of different length would tear the law.
constexpr int uneven_steps = 10;

}  // namespace

template <int M>
void JerkSolver<M>::start(double mu, PlanningPulse& pulse) {
  const auto& p = *problem_;
  const auto& x = *x_;
  n_ = p.cells.size();
  dx_.assign(n_ + 1, {});
  speed_.assign(n_ + 1, {});
  cell_.resize(n_);
  node_.resize(n_ + 1);
  acceleration_.resize(p.nodes.size());
  weight_.resize(n_);
  for (std::size_t i = 1; i < n_; ++i) speed_[i] = jerk_speed(x[i].b);
  // A slack starts at what is free, but not too near the wall.
  const double least = std::min(0.1, mu);
  scale_ = 0;
  for (std::size_t c = 0; c < n_; ++c) {
    pulse(c, n_);
    evaluate(c);
    weight_[c] = cell_[c].law.T;
    for (std::size_t e = 0; e < 2; ++e)
      cell_[c].jerk[e].begin(rows_at(c, e).g, lanes<M>(p.cells[c].share[e]), mu * weight_[c], least);
    scale_ += 2 * 2 * M * weight_[c];
  }
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    const auto& set = p.nodes[i];
    acceleration_[i].begin(lanes<M>(set.p) * x[set.node].b + lanes<M>(set.q) * x[set.node].a, lanes<M>(set.share),
                           mu * weight(set.node), least);
    scale_ += 2 * M * weight(set.node);
  }
  for (std::size_t i = 1; i < n_; ++i) {
    node_[i].cap.begin((x[i].b + cap_slopes(i) * x[i].a) * lanes<2>(p.inverse_cap[i]), all_lanes<2>(1), mu * weight(i),
                       least);
    scale_ += 2 * weight(i);
  }
  start_middles(mu);
  steps_.still(n_);
}

/// Rows for cells' middles may come later than the others.
template <int M>
void JerkSolver<M>::start_middles(double mu) {
  const auto& p = *problem_;
  const auto& x = *x_;
  middle_.resize(p.middles.size());
  for (std::size_t i = 0; i < p.middles.size(); ++i) {
    const auto& set = p.middles[i];
    const JerkMiddle m = middle_at(set.cell);
    middle_[i].rows.begin(lanes<M>(set.d2) * (x[set.cell].b + x[set.cell + 1].b) + lanes<M>(set.d1) * m.g,
                          lanes<M>(set.share), mu * weight_[set.cell], std::min(0.1, mu));
    scale_ += 2 * M * weight_[set.cell];
  }
}

template <int M>
void JerkSolver<M>::move_nodes() {
  for (std::size_t i = 1; i < n_; ++i) move_node(i);
}

template <int M>
JerkSolverResult JerkSolver<M>::solve(const JerkProblem<M>& problem, LargeVector<JerkNode>& x, double mu,
                                      const JerkSolverOptions& options, PlanningPulse& pulse) {
  problem_ = &problem;
  x_ = &x;
  n_ = problem.cells.size();
  x[1].a = rest_tie(problem.cells[0].h) * x[1].b;
  x[n_ - 1].a = -rest_tie(problem.cells[n_ - 1].h) * x[n_ - 1].b;
  if (mu > 0) start(mu, pulse);
  if (mu == 0 && middle_.size() != problem.middles.size()) start_middles(gap_ / scale_);
  steps_.still(n_);
  JerkSolverResult result;
  int stuck = 0;
  target_ = moved_target_ = mu > 0 ? mu : gap_ / scale_;
  for (;; ++result.iterations) {
    assemble(pulse);
    result.duration = duration_;
    result.gap = gap_ / duration_;
    result.violation = violation_;
    result.mu = gap_ / scale_;
    if (!std::isfinite(duration_ + gap_)) break;
    direction(pulse);
    if (result.gap <= options.gap && result.violation <= options.violation &&
        std::abs(promise_) <= options.gap * duration_) {
      result.converged = true;
      break;
    }
    if (result.iterations == options.iterations) break;
    steps_.fit(std::max(0.9, 1 - 10 * target_), mu > 0 || result.iterations >= uneven_steps);
    // What the next step aims at: the less of this one could be taken, the nearer to the present μ.
    const double step = std::min(steps_.mean_primal, steps_.mean_dual), miss = 1 - step;
    const double now = (1 - step) * gap_ / scale_ + step * target_;
    moved_target_ = target_;
    target_ = std::max(now * std::clamp(miss * miss, 0.1, 0.8), least_gap * options.gap * duration_ / scale_);
    stuck = step < stuck_step ? stuck + 1 : 0;
    if (stuck == stuck_steps) {  // too near a wall: from here again, with slacks and multipliers in balance
      move_nodes();
      target_ = std::min(0.1, std::max(1e-3, 10 * now));
      start(target_, pulse);
      stuck = 0;
    }
  }
  return result;
}

template class JerkSolver<2>;
template class JerkSolver<3>;
template class JerkSolver<4>;

}  // namespace bahnwerk
