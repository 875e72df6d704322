#pragma once
/// Beginning and end of each block of a contour in the time of a law.
#include <vector>

#include "core/contour/contour.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Beginning and end of a block in the time of the law, s. They are equal for a block without length and for one that
/// the motion never reaches.
struct BlockTime {
  double begin = 0, end = 0;
};

/// Returns one entry per block of the contour, in order, without gaps. A piece of the law belongs to the block of its
/// path segment, a dwell (core/motion/law/dwell.hpp) to the block of its rest. O(pieces + blocks + rests).
std::vector<BlockTime> block_times(const Contour& contour, const TimeLaw& law);

}  // namespace bahnwerk
