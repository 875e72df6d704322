#pragma once
/// Interior-point method for JerkProblem: Newton's method on the perturbed optimality conditions with slacks and
/// multipliers of every row [Wright: Primal-Dual Interior-Point Methods, 1997; Nocedal, Wright: Numerical Optimization,
/// ch. 19].
///
/// The unknowns of a node couple to the next node's only, so one Newton step is a block-tridiagonal Cholesky
/// factorisation with 2 × 2 blocks. Rows are linearised where the iterate is; of the second derivatives only the
/// objective's convex part is kept. The complementarity of a row is driven to μ times the duration of its cell, so that
/// the gap Σ s z is shared out like time. Cost: O(cells) per iteration, about 0.2 µs per cell and
/// iteration; 10 to 20 iterations from a rough start, a few more as the number of cells grows.
#include <cstddef>

#include "core/motion/jerk_problem.hpp"
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
  /// State of M two-sided rows: slacks and multipliers of both sides, value, change of the value along the step.
  struct Rows {
    std::array<double, M> sp, sm, zp, zm, g, d;
  };
  struct Cap {  // towards the left and the right cell
    std::array<double, 2> s{1, 1}, z{};
  };
  /// What cap e of node i allows of b: inverse_cap · (1, q) · (b, a).
  double cap_slope(std::size_t i, std::size_t e) const {
    return (e ? problem_->cells[i].h : -problem_->cells[i - 1].h) * (2.0 / 3);
  }
  struct Elimination {  // of one node: x = y − F x_next
    double fbb, fba, fab, faa, yb, ya;
  };
  struct Block {
    double bb = 0, ba = 0, aa = 0, rb = 0, ra = 0;
  };

  void start(double mu, PlanningPulse& pulse);
  void start_middles(double mu);
  void assemble(double target, PlanningPulse& pulse);
  void direction(double target, PlanningPulse& pulse);
  void advance(double target, double primal, double dual, PlanningPulse& pulse);

  void evaluate(std::size_t c);
  template <class Visit>
  void cell_rows(std::size_t c, Visit&& visit);
  double weight(std::size_t node) const { return 0.5 * (weight_[node - 1] + weight_[node]); }

  const JerkProblem<M>* problem_ = nullptr;
  LargeVector<JerkNode>* x_ = nullptr;
  std::size_t n_ = 0;
  LargeVector<JerkNode> dx_;
  LargeVector<JerkCell> cell_;
  LargeVector<Rows> jerk_, node_, middle_;
  LargeVector<Cap> cap_;
  LargeVector<Elimination> elimination_;
  LargeVector<double> weight_;
  double duration_ = 0, gap_ = 0, violation_ = 0, scale_ = 0;
  double most_primal_ = 0, most_dual_ = 0, promise_ = 0;
};

extern template class JerkSolver<2>;
extern template class JerkSolver<3>;
extern template class JerkSolver<4>;

}  // namespace bahnwerk
