#pragma once
/// A whole chain, coarse to fine, window by window where there are many points.
#include <functional>

#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// From rest at the first point to rest at the last one, about as quick as can be. A window of edges is planned from
/// the state in which the last one left its first point to rest at its last point; some 800 edges of it are kept, as
/// far as twice the way that braking takes before its end. Memory for the points' cells and one window's system.
/// `report` is told which fraction is done, at every iteration, and may throw. `all_edges`: how many edges there are in
/// all, of which these are some; the more, the less is done for each.
template <int D>
CellChain<D> plan_chain(const ChainLimits<D>& limits, std::size_t all_edges, const std::function<void(double)>& report);

}  // namespace bahnwerk
