#pragma once
/// Farkas certificate: a proof that no trajectory of a chain (chain.hpp) stays inside its boxes on an interval of
/// nodes, whatever happens before and after it.
///
/// Multipliers z of the state boxes (positive for an upper bound, negative for a lower one) weigh the sum Σ z·(x −
/// bound), which is at most 0 for every trajectory inside the boxes. The sum is linear, so its least value over all
/// admissible controls and all states at the first node follows from one backward recursion of the costates. A positive
/// least value proves infeasibility (lemma of Farkas). The proof holds for arbitrary multipliers, so errors of the
/// solver that proposed them cannot make it wrong.
#include <cstddef>
#include <vector>

#include "core/redundant/chain/chain.hpp"

namespace bahnwerk {

template <std::size_t order>
struct Certificate {
  std::size_t first = 0, last = 0;             ///< nodes of the interval, inclusive
  std::vector<ChainState<order>> multipliers;  ///< at the nodes first … last
  ChainState<order>
      at_end{};      ///< multipliers of the condition of rest, used if `last` is the end of the chain; [0] is 0
  double value = 0;  ///< least value of the sum, see infeasibility(); positive: proof
};

/// Returns the least value of the weighted sum over all admissible controls; −∞ where an infinite box leaves it
/// unbounded. `costates`, if given, receives the costates at the nodes `first` … `last`. O(nodes).
template <std::size_t order>
double infeasibility(const Chain<order>& chain, const Certificate<order>& certificate,
                     std::vector<ChainState<order>>* costates = nullptr);

extern template double infeasibility(const Chain<2>&, const Certificate<2>&, std::vector<ChainState<2>>*);
extern template double infeasibility(const Chain<3>&, const Certificate<3>&, std::vector<ChainState<3>>*);

}  // namespace bahnwerk
