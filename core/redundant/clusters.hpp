#pragma once
/// Where a chain cannot stay inside its boxes, and what more time there would help: from the solution with the least
/// excess and its multipliers.
#include <cstddef>
#include <vector>

#include "core/redundant/certificate.hpp"
#include "core/redundant/chain_solver.hpp"

namespace bahnwerk {

template <std::size_t order>
struct Cluster {
  std::size_t first = 0, last = 0;  ///< nodes between which the costates are at least a hundredth of their peak
  Certificate<order> certificate;   ///< proves something only where its value is positive
  double need = 0;                  ///< what has to be gained, at least: its value, or the weighted excess
  /// By how much the value falls per unit of time by which a cell of the stretch is lengthened: −λ·(d/dt of the state),
  /// the Hamiltonian of optimal control.
  std::vector<double> gain;
};

/// Returns groups of nodes whose states exceed their boxes by more than `tolerance`, each with the stretch around it
/// that its multipliers reach over. O(nodes).
template <std::size_t order>
std::vector<Cluster<order>> clusters(const Chain<order>& chain, const ChainSolution<order>& solution, double tolerance);

extern template std::vector<Cluster<2>> clusters(const Chain<2>&, const ChainSolution<2>&, double);
extern template std::vector<Cluster<3>> clusters(const Chain<3>&, const ChainSolution<3>&, double);

}  // namespace bahnwerk
