#pragma once
/// Receding-horizon solution of a long chain: windows of cells are solved one after the other, so that memory and time
/// per window do not grow with the length of the chain.
///
/// Each window begins with the last kept state of the window before. It looks ahead beyond its kept cells and ends free
/// inside the boxes there. If the look-ahead exceeds the time that a stop takes, a window rarely ends in a state from
/// which the next one is infeasible; it still can, so an excess found here proves nothing about the whole chain. How
/// much energy is lost against the solution of the whole depends on the look-ahead compared with the time constant of
/// the motion, which is the time in which the root mean square of its acceleration moves the axis by one unit of
/// length: a look-ahead of several time constants makes the loss negligible. An axis that can stand still is not moved.
/// Cost: O(cells).
#include <cstddef>
#include <utility>
#include <vector>

#include "core/redundant/chain/chain_solver.hpp"

namespace bahnwerk {

struct ChainWindowOptions {
  std::size_t kept = 4000;  ///< cells of a window that are kept
  double ahead = 10;        ///< least look-ahead in the chain's unit of time
  double own_times = 3;     ///< look-ahead in time constants of the window before, at most `kept` cells
  double followed = 0;      ///< excess up to which a solution counts as feasible
};

template <std::size_t order>
struct WindowedSolution {
  std::vector<ChainState<order>> states;  ///< at the n + 1 nodes
  std::vector<double> controls;           ///< in the n cells
  double energy = 0;                      ///< Σ h·a², see ChainSolution
  std::size_t iterations = 0;             ///< Newton iterations of all windows
  std::vector<std::pair<std::size_t, std::size_t>>
      exceeds;  ///< intervals of infeasible nodes, ascending: first and last node
};

/// Returns the solution of a chain. Where it has a small excess, the chain is solved again with a larger penalty,
/// because multipliers may have been above the first one.
template <std::size_t order>
ChainSolution<order> solve_raising_penalty(const Chain<order>& chain, ChainOptions options);

template <std::size_t order>
/// Returns the joined solution of all windows.
WindowedSolution<order> solve_in_windows(const Chain<order>& chain, const ChainOptions& options,
                                         const ChainWindowOptions& windows);

extern template ChainSolution<2> solve_raising_penalty(const Chain<2>&, ChainOptions);
extern template ChainSolution<3> solve_raising_penalty(const Chain<3>&, ChainOptions);
extern template WindowedSolution<2> solve_in_windows(const Chain<2>&, const ChainOptions&, const ChainWindowOptions&);
extern template WindowedSolution<3> solve_in_windows(const Chain<3>&, const ChainOptions&, const ChainWindowOptions&);

}  // namespace bahnwerk
