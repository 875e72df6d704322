#pragma once
/// How often rotary axes have come round, along a path: inverse() gives any of the positions that are one place.
#include <cstddef>
#include <vector>

#include "core/machine/axis_jet.hpp"

namespace bahnwerk {

class KinematicAxisPath;

/// Adds the whole periods that make every axis continuous along a path and, where its range allows, keep it inside: the
/// middle between its extremes is brought as close as possible to that of the range; an axis without range begins
/// within half a period of 0.
///
/// The path is divided into stretches on which, by MapBounds, no such axis leaves a quarter of its period about the
/// stretch's middle: so what is found is proven to be continuous, and the poses between to be reachable.
class AxisTurns {
 public:
  AxisTurns() = default;  ///< adds nothing
  /// Reads the path before it has any. O(stretches), of some 1/100 of a quarter turn at least each, 1 µs a piece.
  /// Throws UnreachablePose where no stretch is short enough, as next to a singularity.
  explicit AxisTurns(const KinematicAxisPath& path);
  /// O(log stretches of the segment); nothing to do for machines without such axes.
  void add(std::size_t segment, double u, AxisArray& position) const;

 private:
  struct Stretch {
    double end = 0;  ///< parameter
    AxisArray middle{};
  };
  AxisArray period_{};
  std::size_t axes_ = 0;
  std::vector<Stretch> stretches_;
  std::vector<std::size_t> first_;  ///< of each segment, and one for the end
};

}  // namespace bahnwerk
