#pragma once
/// A run of segments seen from its other end. A contour and the same contour backwards are smoothed from the same end,
/// chosen by their shape, so that both become the same curve.
#include <memory>
#include <vector>

#include "core/contour/blend/smooth_run.hpp"

namespace bahnwerk::blending {

/// Whether a run is smoothed from its end: by the first of several chords that is longer at the begin than its mirror
/// image at the end, by 1e-7 of itself. Neither frame nor direction of the contour matters; a run that is its own
/// mirror image begins where it begins. O(log elements).
bool begins_at_end(const Stretch& stretch, const RunRange& range);

class ReversedRun {
 public:
  /// Copies the elements on which the range lies. O(elements of the range).
  ReversedRun(const Stretch& stretch, const RunRange& range);
  const Stretch& stretch() const { return stretch_; }
  const RunRange& range() const { return range_; }
  /// What smoothing of that gave, in the direction of the given run. O(pieces).
  SmoothedRun turned_back(SmoothedRun run) const;

 private:
  std::vector<std::unique_ptr<Segment>> segments_;  ///< of curved elements
  Stretch stretch_;
  RunRange given_, range_;
  double end_ = 0;  ///< a place t of the given stretch is end_ − t here
};

}  // namespace bahnwerk::blending
