#pragma once
/// Which loose curves belong together: ends that meet are joined, so that as few and as smooth chains as possible
/// remain.
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

class Progress;

/// What chaining has to know of a curve (which may itself be several curves end to end).
struct Strand {
  Vec from, to;                      ///< mm
  Vec from_direction, to_direction;  ///< unit tangents there, in the direction from → to
  double length = 0;                 ///< mm, roughly
};

struct ChainLink {
  std::size_t strand = 0;
  bool reversed = false;
};
struct StrandChain {
  std::vector<ChainLink> links;
  bool closed = false;
};

/// Every strand is in exactly one chain. Ends within `tolerance` (mm) of each other may be joined, each with one other
/// at most. Where several coincide (to a tenth of the tolerance) the pair with the smallest tangent turn is joined
/// first, over what is then left larger gaps are closed, nearest first; equal cases in the order of the strands. So the
/// result does not depend on which strand a walk would begin with. A strand whose own ends meet (within the tolerance
/// and a tenth of its length) is a closed chain of its own.
///
/// Chains come in the order of their first strand; that strand keeps its direction, and a closed chain starts with it.
/// O(n log n). Of more than 8 earlier ends around one end 8 are considered (which ones is deterministic).
std::vector<StrandChain> chains(const std::vector<Strand>& strands, double tolerance, Progress& progress);

}  // namespace bahnwerk
