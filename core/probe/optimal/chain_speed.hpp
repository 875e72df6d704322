#pragma once
/// A chain as a whole, slower or quicker on the path that it has.
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// The factor by which the chain has to be slowed so that speed, acceleration, jerk and snap are kept with room
/// `margin` (0.01: 1 % below the limit); below 1 where it may be quicker.
template <int D>
double slowing_factor(const CellChain<D>& chain, const ChainLimits<D>& limits, double margin);

/// The motion that lasts `factor` times as long, on the path that it has.
template <int D>
void slow_down(CellChain<D>& chain, double factor);

}  // namespace bahnwerk
