#pragma once
/// Interior-point method for a Chain: Mehrotra's predictor–corrector method [Mehrotra, On the implementation of a
/// primal-dual interior point method, 1992] with Newton systems solved by a Riccati recursion over the nodes [Rao,
/// Wright, Rawlings, Application of interior-point methods to model predictive control, 1998].
///
/// Boxes of states are soft constraints with an exact penalty: each unit of excess costs `penalty`, so a solution
/// always exists, and a solution without excess solves the hard problem as long as all its multipliers are below the
/// penalty. A control whose box is narrower than `fixed_width` is fixed at the middle of its box. When rounding
/// prevents another step, the last iterate is returned: its states are finite, and `excess` tells whether they satisfy
/// the boxes. Time and memory are O(cells) per iteration.
#include <cstddef>
#include <functional>
#include <vector>

#include "core/redundant/chain/chain.hpp"

namespace bahnwerk {

struct ChainOptions {
  double penalty = 1e4;
  double gap = 1e-4;          ///< duality gap at which iterations end, relative to 1 + the objective
  double fixed_width = 1e-6;  ///< controls with a narrower box are fixed
  int max_iterations = 80;
  bool any = false;            ///< whether iterations end at the first iterate inside all boxes, whatever its energy
  std::function<void()> tick;  ///< called every iteration; may throw
};

template <std::size_t order>
struct ChainSolution {
  std::vector<ChainState<order>> states;  ///< states at the n + 1 nodes
  std::vector<double> controls;           ///< controls in the n cells
  std::vector<ChainState<order>>
      multipliers;  ///< per node, of the state boxes: positive for the upper bound, negative for the lower one
  ChainState<order> at_end{};  ///< multipliers of the condition of rest at the end
  double excess =
      0;  ///< largest amount by which a state leaves its box, or a derivative at an end at rest differs from 0
  double energy = 0;  ///< Σ h·a², see chain.hpp
  int iterations = 0;
  bool converged = false;
};

template <std::size_t order>
/// Returns the solution of the penalised problem. `converged` is false where iterations ended before the gap was
/// reached.
ChainSolution<order> solve(const Chain<order>& chain, const ChainOptions& options);

extern template ChainSolution<2> solve(const Chain<2>&, const ChainOptions&);
extern template ChainSolution<3> solve(const Chain<3>&, const ChainOptions&);

}  // namespace bahnwerk
