#pragma once
/// A run of segments traversed backwards. A contour and its reverse are smoothed from one end, chosen by shape, so that
/// both become one curve.
#include <memory>
#include <vector>

#include "core/contour/blend/smooth_run.hpp"

namespace bahnwerk::blending {

/// A range of an element run, traversed backwards.
class ReversedRun {
 public:
  /// Copies the elements of the range. O(elements of the range).
  ReversedRun(const ElementRun& stretch, const RunRange& range);
  const ElementRun& stretch() const { return stretch_; }
  const RunRange& range() const { return range_; }
  /// Returns the result of smoothing in the direction of the given run. O(pieces).
  SmoothedRun turned_back(SmoothedRun run) const;

 private:
  std::vector<std::unique_ptr<Segment>> segments_;  ///< reversed segments of the curved elements
  ElementRun stretch_;
  RunRange given_, range_;
  double end_ = 0;  ///< place t of the given run is end_ − t here
};

}  // namespace bahnwerk::blending
