#pragma once
/// How far a split of a head's motion into coarse and fine axes uses their limits: what methods that adapt limits until
/// the split is valid look at.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Peaks per axis, looked for at both ends, middle and quarters of every stretch on which neither motion has a joint:
/// exact for what is linear there, close for the rest. The verifier decides. O(pieces of both).
std::vector<RedundancyPeaks> split_peaks(const Motion& head, const Motion& coarse, ProgressScope& scope);
/// Returns the peaks of each part between those times, ascending, before the first and behind the last one. A stretch
/// belongs to the part that its middle lies in.
std::vector<std::vector<RedundancyPeaks>> split_peaks(const Motion& head, const Motion& coarse,
                                                      const std::vector<double>& borders, ProgressScope& scope);

/// What kinds of limits are exceeded: the largest quotient of a peak and its limit, over all axes. 1: just reached.
struct SplitUse {
  double coarse_velocity = 0, coarse_acceleration = 0;
  double offset = 0, fine_velocity = 0, fine_acceleration = 0;
  double most() const;
};
SplitUse use_of(const std::vector<RedundancyPeaks>& peaks, const CoarseFineMachine& machine);

}  // namespace bahnwerk
