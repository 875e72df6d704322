#pragma once
/// A head's motion divided into cells that are short enough for a coarse axis with a constant acceleration (or jerk) in
/// each: states of the axes at the nodes and ranges of acceleration and jerk in the cells.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/limits.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/chain/chain.hpp"

namespace bahnwerk {

/// The path's segments [first, last).
struct SegmentRange {
  std::size_t first = 0, last = 0;
};

struct HeadNode {
  double x = 0, v = 0, a = 0;     ///< mm, mm/s, mm/s²; v and a are the limits from the right
  double v_jump = 0, a_jump = 0;  ///< jumps of v and a at the node, where tangent or curvature jump
};
struct HeadCell {
  Range acceleration, jerk;  ///< mm/s², mm/s³; ranges inside the cell
};

/// n cells and n + 1 nodes per axis.
struct HeadCells {
  std::vector<double> times;                 ///< times of the nodes, s, ascending
  std::vector<std::vector<HeadNode>> nodes;  ///< [axis][node]
  std::vector<std::vector<HeadCell>> cells;  ///< [axis][cell]
  std::vector<std::size_t> pieces;           ///< piece of the time law in which each cell begins
  std::size_t size() const { return times.empty() ? 0 : times.size() - 1; }
};

struct HeadCellOptions {
  double longest = 1e-3;     ///< s
  std::vector<Limits> held;  ///< per axis: limits that the head is known to keep; ranges are cut there
  /// Per axis, mm/s²: largest change of the acceleration in a cell, and largest product of the jerk's range and the
  /// cell's duration. A piece that exceeds them is divided, unless it is too short for that; pieces are merged only as
  /// long as the cell keeps them. Infinite where a criterion does not apply.
  std::vector<double> acceleration_change, jerk_change;
  /// Per axis, mm/s³: largest range of the jerk in a cell, however short it is.
  std::vector<double> jerk_range;
};

/// Returns the cells of the whole motion. Pieces of the time law are divided evenly, or merged as long as the options
/// hold. No cell contains a jump of the acceleration above `acceleration_change`; none contains any jump if
/// `jerk_range` is finite. Ranges enclose the polynomial of degree 4 through five samples of each piece, cut at `held`.
/// Cost: O(pieces + duration/longest) with five evaluations of the path each.
HeadCells head_cells(const PathMotion& head, const HeadCellOptions& options, ProgressScope& scope);
/// Returns the cells of the time law's pieces [first, last) only; times are those of the law.
HeadCells head_cells(const PathMotion& head, std::size_t first, std::size_t last, const HeadCellOptions& options,
                     ProgressScope& scope);

}  // namespace bahnwerk
