#pragma once
/// Interior-point method for JerkProblem: Newton's method on the perturbed optimality conditions with slacks and
/// multipliers of every row [Wright: Primal-Dual Interior-Point Methods, 1997; Nocedal, Wright: Numerical Optimization,
/// ch. 19].
///
/// The unknowns of a node couple to the next node's only, so one Newton step is a block-tridiagonal Cholesky
/// factorisation with 2 × 2 blocks. Rows are linearised where the iterate is; of the second derivatives only the
/// objective's convex part is kept. The complementarity of a row is driven to μ times the duration of its cell, so that
/// the gap Σ s z is shared out like time, and no further than the gap asked for: multipliers that are nearly zero would
/// stand in the way of the next change of shares. Going on from a solution, each stretch of the run takes as much of a
/// step as it can (jerk_steps.hpp), so that the number of steps grows little with the run. Cost: O(cells) per step, 0.2
/// to 0.3 µs per cell with two axes; 13 to 15 steps from a rough start to a gap of 3e-2, about as many again to 1e-4.
#include <algorithm>
#include <cstddef>

#include "core/motion/jerk_elimination.hpp"
#include "core/motion/jerk_problem.hpp"
#include "core/motion/jerk_rows.hpp"
#include "core/motion/jerk_steps.hpp"
#include "core/motion/pulse.hpp"

namespace bahnwerk {

struct JerkSolverOptions {
  double gap = 1e-5;        ///< complementarity relative to the duration at which to stop
  double violation = 1e-6;  ///< of rows, relative to their limits
  int iterations = 60;
};

struct JerkSolverResult {
  int iterations = 0;
  double duration = 0, gap = 0, violation = 0;  ///< at the last iterate; gap relative
  double mu = 0;                                ///< mean complementarity reached
  bool converged = false;
};

template <int M>
class JerkSolver {
 public:
  /// From the states in `x` (inner nodes b > 0), which it improves in place. `mu` is where the barrier starts (1 for a
  /// rough start, small for one near the solution); 0 goes on from the last solution after a change of shares.
  JerkSolverResult solve(const JerkProblem<M>& problem, LargeVector<JerkNode>& x, double mu,
                         const JerkSolverOptions& options, PlanningPulse& pulse);

 private:
  struct CellState {
    JerkCell law;
    std::array<RowState<M>, 2> jerk;     ///< rows at both ends
    std::array<Lanes<M>, 2> by_b, by_a;  ///< their gradients on the node there
  };
  struct NodeState {
    RowState<2> cap;  ///< towards the left and the right cell; the upper side only
    Elimination elimination;
  };
  struct MiddleState {
    RowState<M> rows;
    std::array<double, 4> gradient;
  };
  struct Sums {
    Lanes<M> gap, violation;
    double cap_gap = 0, cap_violation = 0, duration = 0;
  };

  void start(double mu, PlanningPulse& pulse);
  void start_middles(double mu);
  void move_node(std::size_t i) {
    JerkNode& x = (*x_)[i];
    const double part = std::min(steps_.primal[i - 1], steps_.primal[i]);
    x.b += part * dx_[i].b;
    x.a += part * dx_[i].a;
    speed_[i] = jerk_speed(x.b);
  }
  void move_nodes();
  void assemble(PlanningPulse& pulse);
  void assemble_cell(std::size_t c, CellMatrix& K, Sums& sums, std::size_t& next_middle);
  void assemble_node(std::size_t c, NodeBlock& now, Sums& sums, std::size_t& next_node);
  void direction(PlanningPulse& pulse);

  void evaluate(std::size_t c) {
    const auto& x = *x_;
    const double h = problem_->cells[c].h;
    JerkCell& law = cell_[c].law;
    if (c == 0)
      law = rest_cell(x[1].b, h, 1);
    else if (c + 1 == n_)
      law = rest_cell(x[c].b, h, 0);
    else
      law = jerk_cell(x[c], speed_[c], x[c + 1], speed_[c + 1], h);
  }
  JerkRows<M> rows_at(std::size_t c, std::size_t end) const {
    const auto& cell = problem_->cells[c];
    const JerkCell& law = cell_[c].law;
    return jerk_rows<M>(problem_->stations[cell.station + end], (*x_)[c + end], speed_[c + end], end ? law.j2 : law.j1,
                        lanes<M>(problem_->inverse_jerk));
  }
  JerkMiddle middle_at(std::size_t c) const {
    return jerk_middle((*x_)[c], speed_[c], (*x_)[c + 1], speed_[c + 1], cell_[c].law);
  }
  double weight(std::size_t node) const { return 0.5 * (weight_[node - 1] + weight_[node]); }
  /// Of caps i by a, towards both cells, relative to that by b.
  Lanes<2> cap_slopes(std::size_t i) const {
    return lanes<2>({-(2.0 / 3) * problem_->cells[i - 1].h, (2.0 / 3) * problem_->cells[i].h});
  }

  const JerkProblem<M>* problem_ = nullptr;
  LargeVector<JerkNode>* x_ = nullptr;
  std::size_t n_ = 0;
  LargeVector<JerkNode> dx_;
  LargeVector<JerkSpeed> speed_;
  LargeVector<CellState> cell_;
  LargeVector<NodeState> node_;
  LargeVector<RowState<M>> acceleration_;
  LargeVector<MiddleState> middle_;
  LargeVector<double> weight_;
  JerkSteps steps_;
  double target_ = 0, moved_target_ = 0;  ///< μ aimed at now, and by the step that is to be taken
  double duration_ = 0, gap_ = 0, violation_ = 0, scale_ = 0, promise_ = 0;
};

extern template class JerkSolver<2>;
extern template class JerkSolver<3>;
extern template class JerkSolver<4>;

}  // namespace bahnwerk
