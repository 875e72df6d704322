#pragma once
/// The start of the search: a slow motion that keeps every limit and the tube with a margin.
#include "core/probe/optimal/chain.hpp"

namespace bahnwerk {

/// Appends the motion to rest at point `to` to `chain`, which ends at rest at point `from`. Where the curve through
/// three points each stays in the tube, the points are passed in one go, slowly enough for all limits; elsewhere the
/// head rests at both points of the edge and goes along it (append_stopping_edge()). O(points).
template <int D>
void append_start(CellChain<D>& chain, const ChainLimits<D>& limits, std::size_t from, std::size_t to);

}  // namespace bahnwerk
