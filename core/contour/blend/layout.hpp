#pragma once
/// Decides which joints of an element run get a corner blend and which segments are smoothed as one run.
#include <cstddef>
#include <vector>

#include "core/contour/blend/corner.hpp"
#include "core/contour/blend/elements.hpp"

namespace bahnwerk::blending {

/// A replacement of the curves between a and b; the rest is unchanged.
struct Change {
  double a = 0, b = 0;    ///< mm along the run of elements
  bool run = false;       ///< whether the segments are smoothed as one; otherwise it is a corner blend
  std::size_t joint = 0;  ///< element that begins at the joint, for a corner blend
  bool movable = false;   ///< whether the corner blend may become part of a neighbouring run
};

/// Every joint requests a length on both sides (core/contour/blend/corner.hpp). The length of a segment is divided
/// among its joints if they request more than it has. A joint that gets less than 0.8 of its request (0.35 if only the
/// curvature jumps) is crowded: it and everything within its request belong to a run; overlapping requests form one
/// run. Runs end before corners that the tolerance alone limits. `ability[i]` are the machine's limits on element i.
/// O(elements); reports to `progress` every few ms.
std::vector<Change> lay_out(const ElementRun& stretch, double tolerance, const std::vector<Ability>& ability,
                            ProgressScope& progress);

/// Returns, for each of `failure_positions` (ascending) on a run from a to b, the sharpest joint inside the run near
/// that place, as the element that begins there: ascending, without duplicates; no entry where no joint turns. `hint`
/// is an element that does not begin behind a.
std::vector<std::size_t> sharpest_joints(const ElementRun& stretch, double a, double b,
                                         const std::vector<double>& failure_positions, std::size_t hint);

}  // namespace bahnwerk::blending
