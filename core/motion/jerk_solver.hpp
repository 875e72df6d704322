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
/// step as it can (jerk_steps.hpp), so that the number of steps grows little with the run. Two neighbouring cells are
/// calculated with at once (jerk_rows.hpp); jerk_adopt.cpp brings the problem into that form. Cost: O(cells) per step,
/// 0.13 µs per cell with two axes, 1 kB of memory each; 9 to 14 steps from a rough start to a gap of 3e-2, about as
/// many again to 1e-4.
#include <algorithm>
#include <cstddef>
#include <cstring>

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
  /// From the states in `x` (inner nodes b > 0), which it improves in place. Both end nodes stay as they are: at rest,
  /// or, where b > 0, in motion. `mu` is where the barrier starts (1 for a rough start, small for one near the
  /// solution); 0 goes on from the last solution after a change of shares.
  JerkSolverResult solve(const JerkProblem<M>& problem, LargeVector<JerkNode>& x, double mu,
                         const JerkSolverOptions& options, PlanningPulse& pulse);

 private:
  /// Two cells, or nodes, next to each other, their rows and all that these need. Lanes that stand for no inner node or
  /// no cell have rows without gradients and next to no weight.
  struct Cells {
    Twin h, weight;
    JerkCellOf<Twin> law;
    std::array<JerkEndRows<Twin, M>, 2> end;
  };
  struct Nodes {
    Twin weight;
    std::array<Twin, 2> cap, slope;        ///< rows cap (b + slope a) ≤ 1 towards the left and the right cell
    std::array<JerkSide<Twin>, 2> capped;  ///< their states
    JerkNodeRows<Twin, M> rows;
  };
  /// Further rows of one node.
  struct Joint {
    std::size_t node = 0;
    JerkNodeRows<double, M> rows;
  };
  struct Middles {
    std::size_t cells = 0;
    Twin weight;
    JerkMiddleRows<Twin, M> rows;
  };
  /// What both nodes' b, a and speeds are at the ends of two cells.
  struct Ends {
    Twin b1, a1, v1, w1, b2, a2, v2, w2;
  };

  void adopt(const LargeVector<JerkNode>& x);
  void adopt_nodes();
  void adopt_cells();
  /// False: they are others than before, and need to be started.
  bool adopt_middles();
  void start(double mu, PlanningPulse& pulse);
  void start_middles(double mu);
  void move_nodes();
  void evaluate(std::size_t g, const Ends& x);
  NodeBlock<Twin> assemble_nodes(std::size_t g, JerkTotals<Twin>& totals);
  CellMatrix<Twin> assemble_cells(std::size_t g, std::size_t& next_middle, JerkTotals<Twin>& totals);
  void assemble(PlanningPulse& pulse);
  void direct_cells(std::size_t g, std::size_t& next_middle, Twin& primal, Twin& dual);
  void direct_nodes(std::size_t g, Twin& primal, Twin& dual);
  void direction(PlanningPulse& pulse);

  Ends ends(std::size_t g) const {
    const std::size_t i = twin * g;
    return {two(b_, i),     two(a_, i),     two(v_, i),     two(w_, i),
            two(b_, i + 1), two(a_, i + 1), two(v_, i + 1), two(w_, i + 1)};
  }
  bool from_rest() const { return !(b_[0] > 0); }
  bool to_rest() const { return !(b_[n_] > 0); }
  static Twin two(const LargeVector<double>& x, std::size_t i) {
    Twin r;
    std::memcpy(&r, x.data() + i, sizeof r);
    return r;
  }
  static void put(LargeVector<double>& x, std::size_t i, Twin value) {
    std::memcpy(x.data() + i, &value, sizeof value);
  }
  double weight(std::size_t node) const { return nodes_[node / twin].weight[node % twin]; }

  const JerkProblem<M>* problem_ = nullptr;
  std::size_t n_ = 0, groups_ = 0;
  LargeVector<double> b_, a_, v_, w_;  ///< per node: v², a, v, 1/(2v); the last is 0 at rest
  LargeVector<double> db_, da_;
  LargeVector<Cells> cells_;
  LargeVector<Nodes> nodes_;
  LargeVector<Joint> joints_;
  LargeVector<Middles> middles_;
  LargeVector<std::size_t> posed_middles_;  ///< their cells
  LargeVector<Elimination> elimination_;
  JerkSteps steps_;
  double target_ = 0;  ///< μ aimed at
  double duration_ = 0, gap_ = 0, violation_ = 0, scale_ = 0, promise_ = 0;
};

extern template class JerkSolver<2>;
extern template class JerkSolver<3>;
extern template class JerkSolver<4>;

}  // namespace bahnwerk
