#pragma once
/// How far the tool can be from a rest, in either direction along its path, in a given time: the least time to every
/// place, and what lies between two rests as boxes of the axes.
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/verify/bound/lower_bound.hpp"

namespace bahnwerk::verify {

/// Where an axis can be by some time, mm.
struct AxisReach {
  double lowest = 0, highest = 0;
};

/// A stretch of the path and when it can be entered at the earliest.
struct ReachedPiece {
  double after = 0;              ///< s from the rest, ascending
  std::vector<AxisReach> boxes;  ///< per axis
};

struct HeadReach {
  std::vector<ReachedPiece> pieces;  ///< the first is the rest itself
  double until = 0;                  ///< s; pieces that are entered later may be missing
};

/// How long the head dwells before a segment, or behind the last one, s.
double dwell_before(const PathTask& task, std::size_t segment);

/// From the rest before section `from` of `sections` (or after all) along the sections up to the rest before section
/// `to`, backward if to < from, in stretches of at most `step` mm, for `horizon` seconds. No motion that keeps the
/// axes' limits, the feeds, the sections' bounds and the dwells of `task` is at a place of a piece earlier than that
/// (backward: is there later, before it leaves the rest). A curve of length l whose ends are c apart lies in the
/// ellipsoid with these foci and axis l; that encloses pieces whatever the curve is. `dwells`: whether the head stays
/// at the first rest as long as it has to; otherwise it leaves it at once. O(pieces).
HeadReach reached(const PathTask& task, const std::vector<SectionBound>& sections, std::size_t from, std::size_t to,
                  double horizon, double step, bool dwells = true);

/// Boxes of one axis at the times i · spacing, i = 0 … count: that of all pieces reached by then; infinite behind
/// `until`.
std::vector<AxisReach> reach_at(const HeadReach& reach, std::size_t axis, double spacing, std::size_t count);

}  // namespace bahnwerk::verify
