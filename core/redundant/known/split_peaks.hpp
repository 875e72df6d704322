#pragma once
/// Peaks of a split of a head's motion into coarse and fine axes, compared with their limits. Methods that adapt limits
/// until the split is valid use them.
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/coarse_fine.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Returns the peaks per axis over the whole motion, evaluated at the ends, the middle and the quarters of every
/// interval on which both motions are smooth: exact for what is linear there, approximate otherwise. The verifier makes
/// the final decision. O(pieces of both).
std::vector<RedundancyPeaks> split_peaks(const Motion& head, const Motion& coarse, ProgressScope& scope);
/// Returns the peaks [part][axis] of the parts that the ascending times `borders`, s, divide the motion into. An
/// interval belongs to the part that holds its middle.
std::vector<std::vector<RedundancyPeaks>> split_peaks(const Motion& head, const Motion& coarse,
                                                      const std::vector<double>& borders, ProgressScope& scope);

/// Largest quotients of a peak and its limit over all axes, by kind of limit; 1 means that a limit is just reached.
struct SplitUse {
  double coarse_velocity = 0, coarse_acceleration = 0;
  double offset = 0, fine_velocity = 0, fine_acceleration = 0;
  /// Returns the largest of the five quotients.
  double most() const;
};
/// Returns the quotients of `peaks` (one per axis) and the machine's limits.
SplitUse use_of(const std::vector<RedundancyPeaks>& peaks, const CoarseFineMachine& machine);

}  // namespace bahnwerk
