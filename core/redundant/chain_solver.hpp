#pragma once
/// Interior-point method for a Chain: Mehrotra's predictor and corrector [Mehrotra, On the implementation of a
/// primal-dual interior point method, 1992] on a Newton system that a Riccati recursion solves from node to node [Rao,
/// Wright, Rawlings, Application of interior-point methods to model predictive control, 1998].
///
/// Boxes of states are elastic: what exceeds them costs `penalty` per unit, so there always is a solution, and one
/// without excess is one of the hard problem as long as its multipliers are below the penalty. Controls with a box
/// narrower than `fixed_width` are fixed at its middle. Where digits no longer suffice for another step the solution is
/// what the last one led to: states are always numbers, and `excess` tells whether they hold. Cost: O(cells) time and
/// memory per iteration.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/redundant/chain.hpp"

namespace bahnwerk {

struct ChainOptions {
  double penalty = 1e4;
  double gap = 1e-4;          ///< of the objective, relative to 1 + its value, at which it ends
  double fixed_width = 1e-6;  ///< of a control's range
  int max_iterations = 80;
  bool any = false;            ///< whether the first solution inside all boxes will do, whatever its energy
  std::function<void()> tick;  ///< called every iteration; may throw
};

template <std::size_t order>
struct ChainSolution {
  std::vector<ChainState<order>> states;  ///< at the nodes
  std::vector<double> controls;           ///< in the cells
  std::vector<ChainState<order>>
      multipliers;             ///< of the boxes of states: positive of the upper bound, negative of the lower one
  ChainState<order> at_end{};  ///< multipliers of the rest at the end
  double excess = 0;           ///< largest by which a state exceeds its box, or derivatives at the end their 0
  double energy = 0;           ///< Σ h·a²
  int iterations = 0;
  bool converged = false;
};

template <std::size_t order>
ChainSolution<order> solve(const Chain<order>& chain, const ChainOptions& options);

extern template ChainSolution<2> solve(const Chain<2>&, const ChainOptions&);
extern template ChainSolution<3> solve(const Chain<3>&, const ChainOptions&);

}  // namespace bahnwerk
