#pragma once
/// In which order to visit chains: always the nearest one next.
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

class Progress;

/// A chain where it can be entered. An open one has two entries, its ends, and is left at the other one; a closed one
/// is left where it was entered.
struct ChainEntries {
  std::vector<Vec> at;
  bool closed = false;
};
struct ChainVisit {
  std::size_t chain = 0, entry = 0;
};

/// Starts with the first chain at its first entry, then goes to the nearest entry of those left. The tour of nearest
/// neighbours is on average some 25 % longer than the shortest one [Johnson, McGeoch: The traveling salesman problem: a
/// case study in local optimization, 1997]. k-d tree whose emptied branches are not searched: O(n log n) for n entries
/// spread evenly. Every chain needs an entry.
std::vector<ChainVisit> nearest_order(const std::vector<ChainEntries>& chains, Progress& progress);

}  // namespace bahnwerk
