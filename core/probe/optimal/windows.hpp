#pragma once
/// The coarse-to-fine search for a whole chain, window by window where there are many points.
#include <functional>

#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// Returns a locally quickest chain from rest at the first point to rest at the last one. A window of edges is planned
/// from the state in which the window before it leaves its first point to rest at its last point; some 800 edges of it
/// are kept, up to twice the braking distance before its end. Memory: the points' cells and one window's system.
/// `report` receives the completed fraction at every iteration and may throw. The effort per edge decreases with
/// `all_edges`, the number of edges of the problem, of which these may be a part.
template <int D>
CellChain<D> plan_chain(const ChainLimits<D>& limits, std::size_t all_edges, const std::function<void(double)>& report);

}  // namespace bahnwerk
