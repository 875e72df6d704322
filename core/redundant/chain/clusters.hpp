#pragma once
/// Infeasible intervals of a chain, found from the solution with the least excess: a Farkas certificate for each, and
/// how much more time in each cell would help.
#include <cstddef>
#include <vector>

#include "core/redundant/chain/certificate.hpp"
#include "core/redundant/chain/chain_solver.hpp"

namespace bahnwerk {

template <std::size_t order>
struct Cluster {
  std::size_t first = 0, last = 0;  ///< nodes between which the costates are at least 1 % of their peak
  Certificate<order> certificate;   ///< a proof only if its value is positive
  double need =
      0;  ///< what more time has to gain at least: the certificate's value, or the weighted excess if there is no proof
  /// gain[i]: decrease of the certificate's value per unit of time by which cell first + i is lengthened: −λ·(d/dt of
  /// the state), the Hamiltonian of optimal control.
  std::vector<double> gain;
};

/// Returns the groups of nodes whose states exceed their boxes by more than `tolerance`, each with the interval over
/// which its multipliers have an effect. O(nodes).
template <std::size_t order>
std::vector<Cluster<order>> clusters(const Chain<order>& chain, const ChainSolution<order>& solution, double tolerance);

extern template std::vector<Cluster<2>> clusters(const Chain<2>&, const ChainSolution<2>&, double);
extern template std::vector<Cluster<3>> clusters(const Chain<3>&, const ChainSolution<3>&, double);

}  // namespace bahnwerk
