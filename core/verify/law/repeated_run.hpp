#pragma once
/// Recognises arcs on which a law is the same as on an earlier arc, such as a hole at another place. The peaks of
/// the axes are then equal.
#include <cstddef>
#include <vector>

#include "core/geometry/path/rough_shape.hpp"
#include "core/verify/law/verifier.hpp"

namespace bahnwerk::verify {

/// A run is the law on one segment: consecutive pieces. It repeats an earlier one if the segments are arcs with equal
/// frame, radius, sweep and rise, and the pieces begin and end at equal places of the segment with equal durations,
/// speeds, accelerations, jerks and snaps: each to 1e-12 of itself, places to 1e-11 of the radius. Velocity,
/// acceleration and jerk do not depend on the arc's place, so their peaks equal those of the earlier run to a few 1e-11
/// of their summands, which is their resolution anyway. Every number of every run is compared. Runs of few pieces, and
/// on other curves, never count as repeated: searching them costs little more.
class RepeatedRuns {
 public:
  explicit RepeatedRuns(const VerifierInput& input) : in_(input) {}
  /// Returns the end of the run that begins at piece `first` if it repeats an earlier one, which then counts as
  /// checked; else `first`. O(pieces), a few ns each.
  std::size_t skip(std::size_t first);

 private:
  struct Run {
    std::size_t first, last;
  };
  bool same(const Run& a, const Run& b) const;

  const VerifierInput& in_;
  RoughIndex index_;
  std::vector<Run> runs_;
};

}  // namespace bahnwerk::verify
