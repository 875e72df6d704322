#pragma once
/// The parts of a contour between two places at which the path has to stay, as sequences of curves.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "core/contour/contour.hpp"

namespace bahnwerk::blending {

/// A curve of an element run: a path segment, or the line that replaces several tiny ones.
struct Element {
  const Segment* segment = nullptr;  ///< null for a line that replaces several segments
  bool straight = true;
  Vec from, tangent;  ///< beginning and direction of a straight element
  double begin = 0;   ///< place along the run at which the element begins, mm
  double length = 0;  ///< mm
  std::size_t source = 0, block = 0;
  std::size_t first = 0;  ///< path segment with which the element begins

  double end() const { return begin + length; }
  /// Returns h and its derivatives by arc length at `along` ∈ [0, length] from the element's beginning.
  Jet at(double along) const;
  /// Returns the curve between two places; for the whole element the segment's own curve.
  std::shared_ptr<const Curve> part(double a, double b) const;
  /// Returns the parameter of a curved element at `along`.
  double parameter(double along) const {
    return segment->parameter(std::clamp(segment->s0() + along, segment->s0(), segment->s1()));
  }
};

/// Consecutive elements of one mode. The path stays unchanged at both ends.
struct ElementRun {
  std::vector<Element> elements;
  bool rest_begin = true, rest_end = true;  ///< whether the motion rests there, so that the direction is free
  double length() const { return elements.empty() ? 0.0 : elements.back().end(); }
  /// Returns the index of the element that holds `t` (the later one at a joint). O(log n), O(1) with a good hint.
  std::size_t find(double t, std::size_t hint) const;
  /// Returns find(t) for queries in nearly ascending or descending order: O(1) within a few elements of `from`, else
  /// O(log n).
  std::size_t near(double t, std::size_t from) const;
};

/// Returns whether a curve between two places t is traversed from its end: the first of several chords decides that is
/// longer at the beginning than its mirror image at the end, by 1e-7 of its length. The choice is independent of the
/// frame and of the direction of the curve; a curve that is its own mirror image begins at its beginning. `point`
/// returns the point at t, mm; it is called 16 times at most.
bool begins_at_end(double a, double b, const std::function<Vec(double)>& point);

/// What element_runs() merges, and where it divides.
struct ElementOptions {
  double tiny = 0;      ///< mm; shorter lines are merged
  double reversal = 0;  ///< rad; joints that turn by more divide
};

/// Divides the segments [first, last) of a path (all of one mode) at joints that turn by more than `reversal` and at
/// cusps. Lines shorter than `tiny` are merged with neighbours of their block, beginning at one end that
/// begins_at_end() chooses: vertices move by at most that, borders of blocks not at all, and each block has at least
/// one element. `blocks[i]` is the block of segment i. O(segments); reports to `progress`.
std::vector<ElementRun> element_runs(const Path& path, std::size_t first, std::size_t last,
                                     const std::vector<std::size_t>& blocks, const ElementOptions& options,
                                     ProgressScope& progress);

}  // namespace bahnwerk::blending
