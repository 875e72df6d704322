#pragma once
/// Shortens a chain of cells under all limits at once: a feasible primal-dual interior-point method.
///
/// Unknowns: the states of the nodes and the logarithms of the durations of the cells. Every Bézier point of the
/// position lies in its edge's capsule, those of the velocity have norm ≤ speed, those of acceleration, jerk and snap
/// lie within the limits of their axis, hence the motion keeps all limits at all times. The states are those of time
/// itself, so cells next to each other may last differently and the passing times are free; the price is that the
/// constraints are bilinear in states and durations. Each iterate keeps all constraints strictly: a run can end at any
/// iteration.
///
/// The Newton system is block tridiagonal over the nodes (4 D unknowns each), durations are eliminated cell by cell:
/// linear cost, about 4 µs (D = 2) or 10 µs (D = 3) a cell and iteration.
#include <functional>

#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

struct ChainSolverOptions {
  double gap = 1e-3;    ///< the search ends where Σ λ g ≤ gap · duration
  int iterations = 60;  ///< largest number of iterations
  double start_mu = 0;  ///< barrier parameter relative to duration / constraints; 0: chosen
  double shortest = 0;  ///< least duration of a cell, s
};

struct ChainSolverReport {
  int iterations = 0;
  double gap = 0;  ///< Σ λ g / duration
};

/// Shortens `chain`, which has to keep every limit and the tube strictly and stays as it is otherwise. Calls `stop`
/// once an iteration; it may throw.
template <int D>
ChainSolverReport shorten_chain(CellChain<D>& chain, const ChainLimits<D>& limits, const ChainSolverOptions& options,
                                const std::function<void()>& stop);

}  // namespace bahnwerk
