#pragma once
/// JerkProblem for the interior-point method (core/numeric/interior_point/driver.hpp): Newton's steps on the perturbed
/// optimality conditions with slacks and multipliers of every row [Wright: Primal-Dual Interior-Point Methods, 1997;
/// Nocedal, Wright: Numerical Optimization, ch. 19]. Assembling, eliminating and moving are fused into two sweeps
/// (newton.ipp), since a step is bound by memory.
///
/// The unknowns of a node are coupled to the next node's only, so one Newton step is a block-tridiagonal Cholesky
/// factorisation with 2 × 2 blocks. Rows are linearised at the iterate; only the objective's convex part of the second
/// derivatives is used. The complementarity target of a row is μ times the duration of its cell. When the solver
/// continues from a solution, each part of the section takes the largest step that it can (steps.hpp), so the number of
/// steps grows little with the length of the section.
///
/// The elimination runs from both ends of the section towards its middle, with one cell of each half in a vector
/// register (rows.hpp). The second half is traversed backwards in time, which changes the sign of a and leaves b and
/// jerk unchanged, so both halves have one form. The remaining block of the node in the middle gives its step.
/// adopt.ipp brings the problem into this form. Cost: O(cells) per step, 0.11 µs per cell with two axes, 1 kB of memory
/// per cell; 9 to 14 steps from a rough start to a gap of 3e-2, about as many again to 1e-4.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/progress_scope.hpp"
#include "core/motion/jerk/elimination.hpp"
#include "core/motion/jerk/problem.hpp"
#include "core/motion/jerk/rows.hpp"
#include "core/motion/jerk/steps.hpp"
#include "core/numeric/interior_point/driver.hpp"

namespace bahnwerk {

/// The options of the interior-point method.
struct JerkSolverOptions {
  double gap = 1e-5;        ///< complementarity relative to the duration at which the solver stops
  double violation = 1e-6;  ///< violation of rows, relative to their limits, at which the solver stops
  int iterations = 60;
};

/// The outcome of the interior-point method.
struct JerkSolverResult {
  int iterations = 0;
  double duration = 0, gap = 0, violation = 0;  ///< values at the last iterate; gap and violation are relative
  double mu = 0;                                ///< mean complementarity reached
  bool converged = false;
};

/// The interior-point method for a JerkProblem with M limited quantities.
template <int M>
class JerkSolver final : InteriorPointProblem {
 public:
  /// Improves the states in `x` (inner nodes b > 0) in place. Both end nodes stay as they are: at rest, or, where b >
  /// 0, in motion. `mu` is the initial barrier parameter (1 for a rough start, small near the solution); 0 continues
  /// from the last solution after a change of shares.
  JerkSolverResult solve(const JerkProblem<M>& problem, LargeVector<JerkNode>& x, double mu,
                         const JerkSolverOptions& options, ProgressScope& progress);

  /// Adds to `cost`, per cell of the last problem, the time that shares of its jerk limits below 1 cost, s, to first
  /// order by the rows' multipliers.
  void add_share_costs(LargeVector<double>& cost) const;

 private:
  InteriorPointFigures evaluate(double mu) override;
  double dual_residual() override { return std::abs(predicted_decrease_) / duration_; }
  bool factor() override { return true; }  // evaluate() has done so
  StepLengths step(double mu) override;
  void restart(double mu) override;

  /// Cell g of each half with its rows. Lanes that represent no inner node or no cell have rows without gradients and a
  /// negligible weight.
  struct Cells {
    Lane2 h, weight;
    JerkCellOf<Lane2> law;
    std::array<JerkEndRows<Lane2, M>, 2> end;
  };
  /// Node i of each half with its rows; the node in the middle belongs to the first half.
  struct Nodes {
    Lane2 weight;
    Lane2 length;                           ///< length of both neighbouring cells, mm
    std::array<Lane2, 2> cap, slope;        ///< rows cap (b + slope a) ≤ 1 towards the outer and the inner cell
    std::array<JerkSide<Lane2>, 2> capped;  ///< states of these rows
    JerkNodeRows<Lane2, M> rows;
  };
  /// Further rows of one node.
  struct Joint {
    std::size_t node = 0, half = 0;
    JerkNodeRows<double, M> rows;
  };
  struct Middles {
    std::size_t cells = 0;
    Lane2 weight;
    JerkMiddleRows<Lane2, M> rows;
  };
  /// The nodes at the outer and the inner end of two cells.
  struct Ends {
    MovingNode<Lane2> outer, inner;
  };

  void adopt(const LargeVector<JerkNode>& x);
  void adopt_nodes();
  void adopt_cells();
  /// Returns false if these cells differ from the previous ones and have to be initialised.
  bool adopt_middles();
  static void take_middle(const MiddleRows<M>& rows, std::size_t half, Middles& to);
  void start(double mu);
  void start_middles(double mu);
  void move_nodes();
  void evaluate(std::size_t g, const Ends& x);
  NodeBlock<Lane2> assemble_nodes(std::size_t i, JerkTotals<Lane2>& totals);
  CellMatrix<Lane2> assemble_cells(std::size_t g, std::size_t& next_middle, JerkTotals<Lane2>& totals);
  bool joint_at(std::size_t i, std::size_t next) const { return next < joints_.size() && joints_[next].node == i; }
  NodeBlock<Lane2> assemble_joint(Joint& joint, JerkTotals<double>& totals);
  /// Eliminates the nodes next to the section's ends.
  void eliminate_first(const NodeBlock<Lane2>& now, const CellMatrix<Lane2>& K, NodeBlock<Lane2>& after);
  /// Returns the step of the node in the middle from the remaining blocks of both halves.
  JerkNode meet(const NodeBlock<Lane2>& blocks) const;
  void assemble();
  JerkReach<Lane2> direct_cells(std::size_t g, std::size_t& next_middle);
  JerkReach<Lane2> direct_nodes(std::size_t i, std::size_t& next_joint);
  void direction();

  Ends ends(std::size_t g) const {
    return {{b_[g], a_[g], v_[g], w_[g]}, {b_[g + 1], a_[g + 1], v_[g + 1], w_[g + 1]}};
  }
  /// Returns whether the section's end at which a half begins is at rest.
  bool rests(std::size_t half) const { return !(b_[0][half] > 0); }
  /// Returns whether the number of cells is odd. The second half then has one cell less than groups_; a cell of
  /// negligible weight takes its place, and its last node is the one in the middle.
  bool odd() const { return n_ % lane_count != 0; }
  bool missing(std::size_t g, std::size_t half) const { return half == 1 && odd() && g + 1 == groups_; }
  std::size_t node_of(std::size_t i, std::size_t half) const { return half == 0 ? i : n_ - i; }
  std::size_t cell_of(std::size_t g, std::size_t half) const { return half == 0 ? g : n_ - 1 - g; }
  /// Returns the weight of cell g of a half; beyond the node in the middle it is a cell of the other half.
  double cell_weight(std::size_t g, std::size_t half) const {
    return g < groups_ ? cells_[g].weight[half] : cells_[n_ - 1 - g].weight[1 - half];
  }
  /// Returns whether rows of a node are at this place.
  bool holds(std::size_t i, std::size_t half) const { return i > 0 && (half == 0 ? i <= groups_ : i < n_ - groups_); }

  const JerkProblem<M>* problem_ = nullptr;
  ProgressScope* progress_ = nullptr;
  std::size_t n_ = 0, groups_ = 0;    ///< number of cells, and of cells in the longer half
  LargeVector<Lane2> b_, a_, v_, w_;  ///< v², a, v, 1/(2v) of each node; the last one is 0 at rest
  LargeVector<Lane2> db_, da_;
  LargeVector<Cells> cells_;
  LargeVector<Nodes> nodes_;
  LargeVector<Joint> joints_;
  LargeVector<Middles> middles_;
  LargeVector<std::size_t> prepared_middles_;  ///< cells of the middle rows when they were initialised
  std::size_t prepared_cells_ = 0;             ///< cells of the section at that time
  LargeVector<Elimination<Lane2>> elimination_;
  JerkNode middle_;  ///< step of the node in the middle
  JerkSteps steps_;
  int uneven_ = 0;     ///< number of further steps whose lengths vary
  double target_ = 0;  ///< target of μ
  double duration_ = 0, gap_ = 0, violation_ = 0, scale_ = 0, predicted_decrease_ = 0;
};

extern template class JerkSolver<2>;
extern template class JerkSolver<3>;
extern template class JerkSolver<5>;
extern template class JerkSolver<8>;
extern template class JerkSolver<4>;
extern template class JerkSolver<6>;
extern template class JerkSolver<9>;

}  // namespace bahnwerk
