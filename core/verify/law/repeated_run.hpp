#pragma once
/// Arcs on which a law does what it did on an earlier arc: the same hole at another place. Whatever the axes do there
/// they did before.
#include <cstddef>
#include <vector>

#include "core/geometry/path/rough_shape.hpp"
#include "core/verify/verifier.hpp"

namespace bahnwerk::verify {

/// A run is what a law does on one segment: consecutive pieces. It repeats an earlier one if the segments are arcs with
/// the same frame, radius, sweep and rise, and the pieces begin and end at the same places of the segment with the same
/// durations, speeds, accelerations, jerks and snaps: each to 1e-12 of itself, places to 1e-11 of the radius. Where the
/// arc lies does not matter to velocity, acceleration and jerk, so their peaks are then those of the earlier run to a
/// few 1e-11 of what is added up in them, which is what they are resolved to anyway. Every number of every run is
/// compared. Runs of few pieces, and on other curves, are never taken for repeated: looking at them costs little more.
class RepeatedRuns {
 public:
  explicit RepeatedRuns(const VerifierInput& input) : in_(input) {}
  /// The end of the run that begins at piece `first` if it repeats an earlier one, else `first`; it then counts as
  /// looked at. O(pieces), a few ns each.
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
