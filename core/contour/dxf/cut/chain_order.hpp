#pragma once
/// Orders chains by nearest neighbours.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// The entries of a chain. An open chain has two, its ends, and is left at the other one; a closed chain is left where
/// it was entered.
struct ChainEntries {
  std::vector<Vec> at;
  bool closed = false;
};
/// A chain and the entry at which it is entered.
struct ChainVisit {
  std::size_t chain = 0, entry = 0;
};

/// Returns the order of the visits. It starts with the first chain at its first entry, then continues with the nearest
/// remaining entry. A tour of nearest neighbours is on average some 25 % longer than the shortest one [Johnson,
/// McGeoch: The traveling salesman problem: a case study in local optimization, 1997]. It uses a k-d tree whose empty
/// branches are not searched: O(n log n) for n uniformly distributed entries. Every chain needs an entry.
std::vector<ChainVisit> nearest_order(const std::vector<ChainEntries>& chains, Progress progress);

}  // namespace bahnwerk
