#pragma once
/// Enclosures of the places that the tool can reach within a given time of a rest, in both directions along its path: a
/// lower bound of the time to each piece of the path, and boxes of the axes that enclose the piece.
#include <cstddef>
#include <vector>

#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/verify/bound/lower_bound.hpp"

namespace bahnwerk::verify {

/// Interval of an axis' positions, mm.
struct AxisReach {
  double lowest = 0, highest = 0;
};

/// A piece of the path with the earliest time at which it can be entered.
struct ReachedPiece {
  double after = 0;              ///< s after the rest, ascending over pieces
  std::vector<AxisReach> boxes;  ///< per axis
};

struct HeadReach {
  std::vector<ReachedPiece> pieces;  ///< the first is the rest itself
  double until = 0;                  ///< s; pieces that are entered later than this may be missing
};

/// Returns the duration of the dwell before a segment, or behind the last one, s.
double dwell_before(const PathTask& task, std::size_t segment);

struct HeadReachOptions {
  double horizon = unlimited;  ///< time after the rest up to which pieces are wanted, s
  double step = 1;             ///< longest piece, mm
  bool dwells = true;          ///< whether the head stays at the first rest for its dwell; otherwise it leaves at once
};

/// Returns the reach from the rest before section `from` of `sections` (or behind all of them) along the sections up to
/// the rest before section `to`, backward in time if to < from. No motion that keeps the axes' limits, the feeds, the
/// sections' bounds and the dwells of `task` is in a piece earlier than its `after` (backward: later before the rest
/// than it). The boxes enclose pieces of any curve: a curve of length l between points at distance c lies in the
/// ellipsoid with these foci and the axis l. O(pieces).
HeadReach reached(const PathTask& task, const std::vector<SectionBound>& sections, std::size_t from, std::size_t to,
                  const HeadReachOptions& options);

/// Returns, for the times i · spacing, i = 0 … count, the interval of one axis that encloses all pieces reachable by
/// then; infinite behind `until`.
std::vector<AxisReach> reach_at(const HeadReach& reach, std::size_t axis, double spacing, std::size_t count);

}  // namespace bahnwerk::verify
