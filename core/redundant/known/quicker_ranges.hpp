#pragma once
/// Ranges of a reparametrised motion in which the new time law is quicker than the old one [Bock 5.1: B-Bereiche].
#include <vector>

#include "core/motion/law/time_law.hpp"
#include "core/redundant/known/timed_path.hpp"

namespace bahnwerk {

/// A range of the old time with its new law: the rate dt_old/dt_new is 1 at both ends (unless an end is one of the
/// motion's) and above 1 between them.
struct QuickerRange {
  double begin = 0, end = 0;  ///< mm on the TimedPath, whose path length is the old time
  std::vector<LawPiece> pieces;
};

/// Returns the ranges in ascending order. A piece whose rate crosses 1 is divided there, unless almost none of it is
/// above 1: then the whole piece belongs to the range with a rate between 1 and the rate at its other end. O(pieces).
std::vector<QuickerRange> quicker_ranges(const TimeLaw& rate);

/// Returns the law that has the rate 1 except in `ranges`, which are ascending and disjoint. `borders` receives the
/// index of the first piece of each range and of the piece behind it. O(segments + pieces).
TimeLaw with_ranges(const TimedPath& path, const std::vector<QuickerRange>& ranges, std::vector<std::size_t>& borders);

}  // namespace bahnwerk
