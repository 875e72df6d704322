#pragma once
/// Edges from rest to rest as cells, and finer cells for a given motion.
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// Appends the move along edge `edge`, from rest at its first point, where `chain` ends, to rest at the next one, on
/// the segment: one cell, or three where there is room to reach the speed. The cells keep every limit with a margin of
/// 10 %.
template <int D>
void append_stopping_edge(CellChain<D>& chain, const ChainLimits<D>& limits, std::size_t edge);

/// Returns the motion with every cell of a lower level than `level` halved, except those at full speed throughout and
/// those shorter than `shortest`, s. Bézier points of halved cells are closer to the motion.
template <int D>
CellChain<D> refined(const CellChain<D>& chain, const ChainLimits<D>& limits, int level, double shortest);

}  // namespace bahnwerk
