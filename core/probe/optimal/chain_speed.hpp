#pragma once
/// The time scale of a chain: a uniformly slower or quicker motion on its path.
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// Returns the factor by which the chain has to be slowed to keep speed, acceleration, jerk and snap with the margin
/// `margin` (0.01: 1 % below the limit); it is below 1 where the chain may be quicker.
template <int D>
double slowing_factor(const CellChain<D>& chain, const ChainLimits<D>& limits, double margin);

/// Makes the motion last `factor` times as long on its path.
template <int D>
void slow_down(CellChain<D>& chain, double factor);

}  // namespace bahnwerk
