#pragma once
/// Chains that stop at every point, to start from, and finer cells for the same motion.
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// Appends the move along edge `edge`, from rest at its first point, where `chain` ends, to rest at the next one, on
/// the segment: one cell, or three where there is room to reach the speed. Keeps every limit with room.
template <int D>
void append_stopping_edge(CellChain<D>& chain, const ChainLimits<D>& limits, std::size_t edge);

/// Halves every cell of a lower level than `level`, but for those that go at full speed throughout and those that are
/// shorter than `shortest` (s). The motion stays what it is; its Bézier points come closer to it.
template <int D>
CellChain<D> refined(const CellChain<D>& chain, const ChainLimits<D>& limits, int level, double shortest);

}  // namespace bahnwerk
