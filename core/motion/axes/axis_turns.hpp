#pragma once
/// Chooses the whole turns of rotary axes along a path, because inverse() returns any of the positions that are one
/// place of the machine.
#include <cstddef>
#include <vector>

#include "core/machine/axis_jet.hpp"

namespace bahnwerk {

class KinematicAxisPath;

/// Adds the whole periods that make every axis continuous along a path and, where its range allows, keep it inside: the
/// middle between its extremes is brought as close as possible to the middle of the range; an axis without range begins
/// within half a period of 0.
///
/// The path is divided into intervals on which, by MapBounds, no periodic axis leaves a quarter of its period about the
/// interval's middle. This proves that the result is continuous and that all poses are reachable.
class AxisTurns {
 public:
  AxisTurns() = default;  ///< adds nothing
  /// Computes the turns; `path` has none yet. O(intervals) of at least some 1/100 of a quarter turn each, 1 µs per
  /// interval. Throws UnreachablePose where no interval is short enough, as next to a singularity.
  explicit AxisTurns(const KinematicAxisPath& path);
  /// Adds the turns to the positions at a parameter of a segment. O(log of the segment's intervals); O(1) for machines
  /// without periodic axes.
  void add(std::size_t segment, double u, AxisArray& position) const;

 private:
  struct Interval {
    double end = 0;      ///< parameter at which the interval ends
    AxisArray middle{};  ///< positions in the middle of the interval
  };
  AxisArray period_{};
  std::size_t axes_ = 0;
  std::vector<Interval> intervals_;
  std::vector<std::size_t> first_;  ///< first interval of each segment, and one more entry for the end
};

}  // namespace bahnwerk
