#pragma once
/// The shortest duration of a chain of cells as a problem of the interior-point method.
///
/// Unknowns: the states of the nodes and the logarithms of the durations of the cells. Constraints: Bézier points of
/// the position lie in their edge's capsule, those of the velocity have norm ≤ speed, those of acceleration, jerk and
/// snap keep the limits of their axis, points are passed within their balls, no cell is shorter than a given duration.
/// The system of a step is block tridiagonal over the nodes (4 D unknowns each) once the durations are eliminated cell
/// by cell.
#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/numeric/interior_point/feasible.hpp"
#include "core/numeric/linear/block_tridiagonal.hpp"
#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

template <int D>
class ChainProblem final : public FeasibleProblem {
 public:
  /// `chain` is the iterate; `shortest` is the least duration of a cell, s.
  ChainProblem(CellChain<D>& chain, const ChainLimits<D>& limits, double shortest);

  double objective() const override { return chain_.duration(); }
  bool slacks(std::vector<double>& slack) const override { return slacks(chain_, slack); }
  bool step(const BarrierPoint& at) override { return assemble(at) && solve(); }
  double changes(std::vector<double>& change) const override;
  double longest() const override;
  std::size_t curves() const override { return 2; }
  bool go(double length, std::size_t curve, std::vector<double>& slack, double& objective) override;
  void accept() override { std::swap(chain_, trial_); }

 private:
  static constexpr int N = 4 * D;                                 // unknowns of a node
  static constexpr int L = 2 * N;                                 // unknowns of a cell, without its duration
  static constexpr std::size_t tube_rows = CellBasis::first[1];   // rows of the position
  static constexpr std::size_t speed_rows = CellBasis::first[2];  // rows of position and velocity
  using System = BlockTridiagonal<N>;
  using Local = Eigen::Matrix<double, L, L>;
  using LocalVector = Eigen::Matrix<double, L, 1>;

  /// Where the slacks of a cell stand. Those of the velocity follow those of the position, two per axis for each other
  /// row follow these, that of the duration is the last one.
  struct Slots {
    std::size_t begin = 0;
    std::size_t tube_from = 0, tube_to = 0;  // rows of the position that are constrained
    std::size_t curved(std::size_t row) const { return begin + row - (row < tube_rows ? tube_from : skipped()); }
    std::size_t axis(std::size_t row, int k) const {
      return curved(speed_rows) + 2 * (D * (row - speed_rows) + static_cast<std::size_t>(k));
    }
    std::size_t duration() const { return axis(CellBasis::rows, 0); }
    std::size_t end() const { return duration() + 1; }

   private:
    std::size_t skipped() const { return tube_rows - (tube_to - tube_from); }
  };

  double ball_radius(const ChainNode<D>& node) const { return limits_.ball[static_cast<std::size_t>(node.point)]; }
  /// Returns the coordinate of the node relative to the point that it passes, mm.
  double from_point(const ChainNode<D>& node, int axis) const {
    return node.state[0][axis] - limits_.points[static_cast<std::size_t>(node.point)][axis];
  }
  /// Returns whether derivative p of the node's state is given, so that it is no unknown.
  bool given(const ChainNode<D>& node, int p) const {
    return node.given || (p == 0 && node.point >= 0 && ball_radius(node) <= 0) || (p == 1 && node.still);
  }
  double axis_limit(std::size_t row, int axis) const {
    return limits_.derivative[static_cast<std::size_t>(cell_basis().order[row] - 2)][axis];
  }
  /// Calls visit(row, slack, its gradient with respect to the row's value, `round`, u) for the rows of position and
  /// velocity that are constrained. The slack's Hessian is −round (1 − u uᵀ); u = null stands for 0.
  template <typename Visit>
  void curved_row(std::size_t c, std::size_t row, const double* q, Visit&& visit) const;

  bool slacks(const CellChain<D>& chain, std::vector<double>& slack) const;
  bool assemble(const BarrierPoint& at);
  void assemble_cell(std::size_t c, const BarrierPoint& at, Local& a, LocalVector& b, LocalVector& gradient);
  void assemble_nodes(const BarrierPoint& at);
  bool solve();
  void row_steps(std::size_t c, double (&dq)[CellBasis::rows][D]) const;
  void move_node(std::size_t n, double length, bool powers, ChainNode<D>& node) const;

  CellChain<D>& chain_;
  CellChain<D> trial_;
  const ChainLimits<D>& limits_;
  double shortest_;
  std::vector<Capsule<D>> capsule_;  // about each edge
  std::vector<Slots> slots_;         // of each cell
  std::vector<std::size_t> ball_;    // nodes that pass their point within a ball; their slacks follow those of cells
  std::vector<CellValues<D>> values_;
  System system_;
  typename System::Vectors step_;  // of node n: derivative p of axis k at p D + k
  std::vector<LocalVector, Eigen::aligned_allocator<LocalVector>> tau_row_;
  std::vector<double> tau_diagonal_, tau_step_;  // tau: the logarithm of a duration
};

/// Shortens `chain`, which has to keep every limit and the tube strictly and stays as it is otherwise. Its states are
/// those of time itself, so cells next to each other may last differently and the passing times are free; the price is
/// that constraints are bilinear in states and durations. About 4 µs (D = 2) or 10 µs (D = 3) a cell and iteration.
template <int D>
FeasibleResult shorten_chain(CellChain<D>& chain, const ChainLimits<D>& limits, double shortest,
                             const FeasibleOptions& options) {
  ChainProblem<D> problem(chain, limits, shortest);
  return solve_feasible(problem, options);
}

}  // namespace bahnwerk
