#pragma once
/// The Newton step of a chain's barrier problem.
///
/// The system is block tridiagonal over the nodes (4 D unknowns each); the logarithms of the durations are eliminated
/// cell by cell, the rest is solved by block Cholesky factors. Where the matrix is not positive definite there is no
/// step; more damping makes it positive definite.
#include <Eigen/Dense>
#include <vector>

#include "core/probe/optimal/chain_constraints.hpp"

namespace bahnwerk {

struct Barrier {
  double mu = 0;         ///< weight of −Σ ln of the slacks, s
  double damping = 0;    ///< addition to the diagonal, relative to it
  double stiffness = 0;  ///< addition to the diagonal of the durations' logarithms, relative to the durations
};

template <int D>
class ChainNewton {
  static constexpr int N = 4 * D;  // unknowns of a node
  static constexpr int L = 2 * N;  // unknowns of a cell, without its duration
  using Block = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  using Slacks = ChainSlacks<D>;

 public:
  ChainNewton(const ChainConstraints<D>& constraints, std::size_t cells);

  /// Computes the primal-dual Newton step from `chain`, its slacks and their multipliers; returns whether there is one.
  bool step(const CellChain<D>& chain, const Slacks& slack, const Slacks& dual, const Barrier& barrier) {
    return assemble(chain, slack, dual, barrier) && solve();
  }
  /// Returns the step of the state of node n: derivative p of axis k at p · D + k.
  const Vector& of_node(std::size_t n) const { return step_[n]; }
  /// Returns the step of the logarithm of a cell's duration.
  double of_duration(std::size_t c) const { return tau_step_[c]; }
  /// Returns the values of the cell's rows at `chain`; row_steps() computes their changes to first order.
  const CellValues<D>& values(std::size_t c) const { return values_[c]; }
  void row_steps(const CellChain<D>& chain, std::size_t c, double (&dq)[CellBasis::rows][D]) const;

 private:
  bool assemble(const CellChain<D>& chain, const Slacks& slack, const Slacks& dual, const Barrier& barrier);
  bool solve();

  const ChainConstraints<D>& constraints_;
  std::vector<CellValues<D>> values_;
  std::vector<Block, Eigen::aligned_allocator<Block>> diag_, off_, coupling_;
  std::vector<Vector, Eigen::aligned_allocator<Vector>> rhs_, step_;
  std::vector<Eigen::LLT<Block>, Eigen::aligned_allocator<Eigen::LLT<Block>>> factor_;
  std::vector<Eigen::Matrix<double, L, 1>, Eigen::aligned_allocator<Eigen::Matrix<double, L, 1>>> tau_row_;
  std::vector<double> tau_diag_, tau_rhs_, tau_step_;
};

}  // namespace bahnwerk
