#pragma once
/// The grid of the relaxation: nodes over the cycle, and the cells between them on which laws are smooth.
///
/// Nodes lie at every point, in the middle of its range where its time is free, and evenly between them. Two nodes of
/// the same time are one place before and behind a jump of the acceleration or the velocity, or two points whose ranges
/// have the same middle: `joined` derivatives are equal there. A section whose law is known but for its position has no
/// cells: its cost follows from its end values.
#include <cstddef>
#include <vector>

#include "core/cam/optimal/task/law_task.hpp"

namespace bahnwerk::cam {

struct RelaxationNode {
  double time;          ///< time of the node, in the task's unit
  std::size_t point;    ///< number of the point at the node; LawTask::none: there is none
  bool before = false;  ///< no cell begins here: its derivatives are the limits from the left
  bool used = false;    ///< a cell begins or ends here
  int joined = 0;       ///< derivatives 0 … joined − 1 are those of the node before it
};
struct RelaxationCell {
  std::size_t left;     ///< left node of the cell; left + 1 is the right one
  int smooth;           ///< derivatives up to this order are certainly continuous inside, 2 at most
  std::size_t section;  ///< the section that it certainly belongs to; LawTask::none: several may have it
};
struct RelaxationGrid {
  std::vector<RelaxationNode> nodes;  ///< a periodic law's last one is its first one, a cycle later
  std::vector<RelaxationCell> cells;
  bool periodic;
  bool closing(std::size_t node) const { return periodic && node + 1 == nodes.size(); }
};

/// Returns whether a section has no cells: a given one, or one whose position or velocity is a number between fixed
/// times.
bool is_known(const LawTask& task, const std::vector<Range>& ranges, std::size_t section);

/// Lays a grid of about `cells` cells, 4 per section at least, by the sections' lengths; with a drive half of them by
/// the number of sections. `ranges` has one entry per point, ascending as tighten()
/// leaves them.
RelaxationGrid lay_grid(const LawTask& task, const std::vector<Range>& ranges, std::size_t cells);

}  // namespace bahnwerk::cam
