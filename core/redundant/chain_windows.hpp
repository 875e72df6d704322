#pragma once
/// A long chain solved window by window: time and memory per window do not grow with the chain, and stay in a cache.
///
/// Each window begins with the state that the one before left, and reaches beyond what is kept of it, anywhere inside
/// the boxes there. With more time ahead than a stop takes it finds a solution where there is one; that one window
/// ended where the next cannot go on is possible, so what exceeds boxes here proves nothing. What lies ahead matters to
/// the energy for some of the motion's own times, in which its acceleration, in the mean square, takes the axis over a
/// unit of length: smooth motions have long ones. So far ahead a window loses next to no energy against the solution of
/// the whole. An axis that can stand still does. O(cells).
#include <cstddef>
#include <utility>
#include <vector>

#include "core/redundant/chain_solver.hpp"

namespace bahnwerk {

struct ChainWindowOptions {
  std::size_t kept = 4000;  ///< cells of a window that are kept
  double ahead = 10;        ///< units of time, at least
  double own_times = 3;     ///< of the window before, that one looks ahead, for as many cells as are kept at most
  double followed = 0;      ///< excess that counts as none
};

template <std::size_t order>
struct WindowedSolution {
  std::vector<ChainState<order>> states;                     ///< at the nodes
  std::vector<double> controls;                              ///< in the cells
  double energy = 0;                                         ///< as of a ChainSolution
  std::size_t iterations = 0;                                ///< of all windows
  std::vector<std::pair<std::size_t, std::size_t>> exceeds;  ///< stretches of nodes, ascending: first and last
};

/// Returns the solution of a chain; where a little is exceeded, that with a larger penalty.
template <std::size_t order>
ChainSolution<order> followed_if_possible(const Chain<order>& chain, ChainOptions options);

template <std::size_t order>
WindowedSolution<order> solve_in_windows(const Chain<order>& chain, const ChainOptions& options,
                                         const ChainWindowOptions& windows);

extern template ChainSolution<2> followed_if_possible(const Chain<2>&, ChainOptions);
extern template ChainSolution<3> followed_if_possible(const Chain<3>&, ChainOptions);
extern template WindowedSolution<2> solve_in_windows(const Chain<2>&, const ChainOptions&, const ChainWindowOptions&);
extern template WindowedSolution<3> solve_in_windows(const Chain<3>&, const ChainOptions&, const ChainWindowOptions&);

}  // namespace bahnwerk
