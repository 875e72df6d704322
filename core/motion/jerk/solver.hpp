#pragma once
/// Interior-point method for JerkProblem: Newton's method on the perturbed optimality conditions with slacks and
/// multipliers of every row [Wright: Primal-Dual Interior-Point Methods, 1997; Nocedal, Wright: Numerical Optimization,
/// ch. 19].
///
/// The unknowns of a node couple to the next node's only, so one Newton step is a block-tridiagonal Cholesky
/// factorisation with 2 × 2 blocks. Rows are linearised where the iterate is; of the second derivatives only the
/// objective's convex part is kept. The complementarity of a row is driven to μ times the duration of its cell, so that
/// the gap Σ s z is shared out like time, and no further than the gap asked for: multipliers that are nearly zero would
/// stand in the way of the next change of shares. Going on from a solution, each stretch of the section takes as much
/// of a step as it can (steps.hpp), so that the number of steps grows little with the section.
///
/// The section is worked on from both its ends at once, towards its middle, with a cell of either half in a vector
/// register (rows.hpp). The second half is passed backwards in time, which turns the sign of a and leaves b and
/// jerk as they are: so both halves are the same problem, and their elimination the same calculation. What is left of
/// both at the node in the middle gives its step. adopt.cpp brings the problem into that form. Cost: O(cells) per
/// step, 0.11 µs per cell with two axes, 1 kB of memory each; 9 to 14 steps from a rough start to a gap of 3e-2, about
/// as many again to 1e-4.
#include <algorithm>
#include <cstddef>

#include "core/base/progress_scope.hpp"
#include "core/motion/jerk/elimination.hpp"
#include "core/motion/jerk/problem.hpp"
#include "core/motion/jerk/rows.hpp"
#include "core/motion/jerk/steps.hpp"

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
                         const JerkSolverOptions& options, ProgressScope& pulse);

  /// Adds to every cell of the last problem the time that shares of its limits of jerk below 1 cost, s: to first order,
  /// by the rows' multipliers.
  void add_share_costs(LargeVector<double>& cost) const;

 private:
  /// Cell g of either half, their rows and all that these need. Lanes that stand for no inner node or no cell have rows
  /// without gradients and next to no weight.
  struct Cells {
    Twin h, weight;
    JerkCellOf<Twin> law;
    std::array<JerkEndRows<Twin, M>, 2> end;
  };
  /// Likewise nodes; the one in the middle is the first half's.
  struct Nodes {
    Twin weight;
    Twin length;                           ///< of both cells next to it
    std::array<Twin, 2> cap, slope;        ///< rows cap (b + slope a) ≤ 1 towards the outer and the inner cell
    std::array<JerkSide<Twin>, 2> capped;  ///< their states
    JerkNodeRows<Twin, M> rows;
  };
  /// Further rows of one node.
  struct Joint {
    std::size_t node = 0, half = 0;
    JerkNodeRows<double, M> rows;
  };
  struct Middles {
    std::size_t cells = 0;
    Twin weight;
    JerkMiddleRows<Twin, M> rows;
  };
  /// What the nodes' b, a and speeds are at the outer and the inner end of two cells.
  struct Ends {
    Twin b1, a1, v1, w1, b2, a2, v2, w2;
  };

  void adopt(const LargeVector<JerkNode>& x);
  void adopt_nodes();
  void adopt_cells();
  /// False: they are others than before, and need to be started.
  bool adopt_middles();
  static void take_middle(const MiddleRows<M>& rows, std::size_t half, Middles& to);
  void start(double mu, ProgressScope& pulse);
  void start_middles(double mu);
  void move_nodes();
  void evaluate(std::size_t g, const Ends& x);
  NodeBlock<Twin> assemble_nodes(std::size_t i, JerkTotals<Twin>& totals);
  CellMatrix<Twin> assemble_cells(std::size_t g, std::size_t& next_middle, JerkTotals<Twin>& totals);
  bool joint_at(std::size_t i, std::size_t next) const { return next < joints_.size() && joints_[next].node == i; }
  NodeBlock<Twin> assemble_joint(Joint& joint, JerkTotals<double>& totals);
  /// Eliminates the nodes next to the section's ends.
  void eliminate_first(const NodeBlock<Twin>& now, const CellMatrix<Twin>& K, NodeBlock<Twin>& after);
  /// The step of the node in the middle from what both halves leave of it.
  JerkNode meet(const NodeBlock<Twin>& blocks) const;
  void assemble(ProgressScope& pulse);
  void direct_cells(std::size_t g, std::size_t& next_middle, Twin& primal, Twin& dual);
  void direct_nodes(std::size_t i, std::size_t& next_joint, Twin& primal, Twin& dual);
  void direction(ProgressScope& pulse);

  Ends ends(std::size_t g) const { return {b_[g], a_[g], v_[g], w_[g], b_[g + 1], a_[g + 1], v_[g + 1], w_[g + 1]}; }
  /// The section's end at which a half begins.
  bool rests(std::size_t half) const { return !(b_[0][half] > 0); }
  /// An odd number of cells leaves the second half with one less than groups_: in its place is one that weighs nothing,
  /// and its last node is the one in the middle.
  bool odd() const { return n_ % twin != 0; }
  bool missing(std::size_t g, std::size_t half) const { return half == 1 && odd() && g + 1 == groups_; }
  std::size_t node_of(std::size_t i, std::size_t half) const { return half == 0 ? i : n_ - i; }
  std::size_t cell_of(std::size_t g, std::size_t half) const { return half == 0 ? g : n_ - 1 - g; }
  /// Of cell g of a half, which may be the other half's last one: beyond the node in the middle.
  double cell_weight(std::size_t g, std::size_t half) const {
    return g < groups_ ? cells_[g].weight[half] : cells_[n_ - 1 - g].weight[1 - half];
  }
  /// Whether rows of a node are at this place.
  bool holds(std::size_t i, std::size_t half) const { return i > 0 && (half == 0 ? i <= groups_ : i < n_ - groups_); }

  const JerkProblem<M>* problem_ = nullptr;
  std::size_t n_ = 0, groups_ = 0;   ///< cells, and of them in the longer half
  LargeVector<Twin> b_, a_, v_, w_;  ///< per node: v², a, v, 1/(2v); the last is 0 at rest
  LargeVector<Twin> db_, da_;
  LargeVector<Cells> cells_;
  LargeVector<Nodes> nodes_;
  LargeVector<Joint> joints_;
  LargeVector<Middles> middles_;
  LargeVector<std::size_t> posed_middles_;  ///< their cells
  std::size_t posed_cells_ = 0;             ///< of the section then
  LargeVector<Elimination<Twin>> elimination_;
  JerkNode middle_;  ///< step of the node in the middle
  JerkSteps steps_;
  double target_ = 0;  ///< μ aimed at
  double duration_ = 0, gap_ = 0, violation_ = 0, scale_ = 0, promise_ = 0;
};

extern template class JerkSolver<2>;
extern template class JerkSolver<3>;
extern template class JerkSolver<5>;
extern template class JerkSolver<8>;
extern template class JerkSolver<4>;
extern template class JerkSolver<6>;
extern template class JerkSolver<9>;

}  // namespace bahnwerk
