#pragma once
/// When a motion works on which block of its contour.
#include <vector>

#include "core/contour/contour.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// s, of the law. A block without a way has begin = end; so has one that the motion never reaches.
struct BlockTime {
  double begin = 0, end = 0;
};

/// One entry per block of the contour, in order, without gaps. A piece of the law belongs to the block of its path
/// segment, a dwell (core/motion/law/dwell.hpp) to the block of its rest. O(pieces + blocks + rests).
std::vector<BlockTime> block_times(const Contour& contour, const TimeLaw& law);

}  // namespace bahnwerk
