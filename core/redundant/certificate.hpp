#pragma once
/// Proof that a chain cannot stay inside its boxes, on a stretch of it, whatever it does before and after.
///
/// Multipliers z of the boxes of states (positive: upper bound) make a weighted sum Σ z·(x − bound) that is at most 0
/// for every motion inside the boxes. Its least value over all controls within theirs and all states at the begin of
/// the stretch follows from one backward recursion of the costates, because the sum is linear [Farkas]. Where that
/// value is positive there is no such motion. Any multipliers prove what they prove: nothing is taken from the solver
/// on trust.
#include <cstddef>
#include <vector>

#include "core/redundant/chain.hpp"

namespace bahnwerk {

template <std::size_t order>
struct Certificate {
  std::size_t first = 0, last = 0;             ///< nodes of the stretch
  std::vector<ChainState<order>> multipliers;  ///< at the nodes first … last
  ChainState<order> at_end{};  ///< multipliers of the rest at the end, if the stretch reaches there; position: 0
  double value = 0;            ///< as infeasibility() gives it
};

/// Returns the least value of the sum, −∞ where an infinite range leaves it unbounded. `costates`, if given, gets the
/// costates at the nodes of the stretch. O(nodes).
template <std::size_t order>
double infeasibility(const Chain<order>& chain, const Certificate<order>& certificate,
                     std::vector<ChainState<order>>* costates = nullptr);

extern template double infeasibility(const Chain<2>&, const Certificate<2>&, std::vector<ChainState<2>>*);
extern template double infeasibility(const Chain<3>&, const Certificate<3>&, std::vector<ChainState<3>>*);

}  // namespace bahnwerk
