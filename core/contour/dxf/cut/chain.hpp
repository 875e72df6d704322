#pragma once
/// Joins loose curves at their ends, so that as few and as smooth chains as possible remain.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// The properties of a curve (which may itself consist of several curves) that chaining needs.
struct Strand {
  Vec from, to;                      ///< mm
  Vec from_direction, to_direction;  ///< unit tangents there, in the direction from → to
  double length = 0;                 ///< mm, roughly
};

/// A strand in a chain, possibly reversed.
struct ChainLink {
  std::size_t strand = 0;
  bool reversed = false;
};
/// Strands end to end.
struct StrandChain {
  std::vector<ChainLink> links;
  bool closed = false;
};

/// Returns the chains. Every strand is in exactly one. Ends within `tolerance` (mm) of each other may be joined, each
/// with at most one other. Where several coincide (to a tenth of the tolerance) the pair with the smallest tangent turn
/// is joined first; then larger gaps between the remaining ends are closed, nearest first. Equal cases are decided by
/// the order of the strands. The result is therefore independent of the strand with which the search begins. A strand
/// whose own ends meet (within the tolerance and a tenth of its length) is a closed chain of its own.
///
/// Chains are in the order of their first strand, which is not reversed; a closed chain starts with it. O(n log n). If
/// more than 8 earlier ends surround an end, 8 of them are considered, by a deterministic choice.
std::vector<StrandChain> chains(const std::vector<Strand>& strands, double tolerance, Progress progress);

}  // namespace bahnwerk
