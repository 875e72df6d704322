#pragma once
/// A head's motion in cells short enough for a coarse axis whose acceleration is constant in each (or whose jerk is):
/// what the axes do at the nodes between them, and between which values their acceleration lies inside.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/machine/limits.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/redundant/chain.hpp"

namespace bahnwerk {

struct HeadNode {
  double x = 0, v = 0, a = 0;     ///< mm, mm/s, mm/s²; v and a just after the node
  double v_jump = 0, a_jump = 0;  ///< what they changed by at the node itself, where tangent or curvature jump
};
struct HeadCell {
  Range acceleration, jerk;  ///< mm/s², mm/s³; what the head does inside
};

/// Of one axis there are cells + 1 nodes.
struct HeadCells {
  std::vector<double> times;                 ///< of the nodes, s
  std::vector<std::vector<HeadNode>> nodes;  ///< [axis][node]
  std::vector<std::vector<HeadCell>> cells;  ///< [axis][cell]
  std::vector<std::size_t> pieces;           ///< of the law: the one in which each cell begins
  std::size_t size() const { return times.empty() ? 0 : times.size() - 1; }
};

struct HeadCellOptions {
  double longest = 1e-3;     ///< s
  std::vector<Limits> held;  ///< per axis, what the head is known to hold: ranges end there
  /// Per axis, mm/s²: what the acceleration changes by in a cell, and the range of the jerk times the cell's duration.
  /// A piece with more is divided, unless it is too short for that; others are not merged. Infinite where it does not
  /// matter.
  std::vector<double> acceleration_change, jerk_change;
  /// Per axis, mm/s³: range of the jerk in a cell, however short.
  std::vector<double> jerk_range;
};

/// Pieces of the law are divided evenly, or merged while they fit. A cell never reaches over a jump of the acceleration
/// that is larger than that, with a limited range of the jerk over none at all. The ranges enclose the polynomial of
/// degree 4 through five values of each piece, as far as the head's limits let it. O(pieces + duration/longest), five
/// evaluations of the path each.
HeadCells head_cells(const PathMotion& head, const HeadCellOptions& options, ProgressScope& scope);
/// Divides the pieces [first, last) of the law alone; times are those of the law.
HeadCells head_cells(const PathMotion& head, std::size_t first, std::size_t last, const HeadCellOptions& options,
                     ProgressScope& scope);

}  // namespace bahnwerk
