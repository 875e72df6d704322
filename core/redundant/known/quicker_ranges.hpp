#pragma once
/// Where a law over the old time is quicker than that time itself [Bock 5.1: B-Bereiche].
#include <vector>

#include "core/motion/law/time_law.hpp"
#include "core/redundant/known/timed_path.hpp"

namespace bahnwerk {

/// A stretch of the old time, and the law on it: 1 at both its ends, unless these are those of the motion, and above 1
/// between them.
struct QuickerRange {
  double begin = 0, end = 0;  ///< mm of the timed path
  std::vector<LawPiece> pieces;
};

/// By begin. A piece whose rate crosses 1 is cut there, unless next to nothing of it is above 1: then it is taken
/// whole, its rate between 1 and what it is at the other end. O(pieces).
std::vector<QuickerRange> quicker_ranges(const TimeLaw& rate);

/// Returns the old time but for those ranges, ascending and apart. `borders` gets the number of the first piece of each
/// range and of the piece behind it. O(segments + pieces).
TimeLaw with_ranges(const TimedPath& path, const std::vector<QuickerRange>& ranges, std::vector<std::size_t>& borders);

}  // namespace bahnwerk
