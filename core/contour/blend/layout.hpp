#pragma once
/// Which joints of a stretch get a blend of their own, and which segments are smoothed as one run.
#include <cstddef>
#include <vector>

#include "core/contour/blend/corner.hpp"
#include "core/contour/blend/elements.hpp"

namespace bahnwerk::blending {

/// What is replaced between a and b along the stretch. The rest stays.
struct Change {
  double a = 0, b = 0;
  bool run = false;
  std::size_t joint = 0;  ///< of a corner blend: the element that begins there
  bool movable = false;   ///< a corner blend that may become part of a neighbouring run
};

/// Every joint wants a length on both sides (core/contour/blend/corner.hpp). A segment whose joints want more than it
/// has is shared out. A joint that gets less than 0.8 of what it wants (0.35 if only the curvature jumps) is crowded:
/// it and all that lies within its wish belong to a run; wishes that overlap make one run. Runs end before corners that
/// the tolerance alone limits. `ability[i]` is what the machine can do on element i. O(elements); `scope` is told
/// every few ms and may throw.
std::vector<Change> lay_out(const Stretch& stretch, double tolerance, const std::vector<Ability>& ability,
                            ProgressScope& scope);

/// For each place of `troubles`, ascending, on a run from a to b: the sharpest joint inside it near that place, by the
/// element that begins there. Ascending, none twice, none where no joint turns. `hint` is an element not behind a.
std::vector<std::size_t> sharpest_joints(const Stretch& stretch, double a, double b,
                                         const std::vector<double>& troubles, std::size_t hint);

}  // namespace bahnwerk::blending
