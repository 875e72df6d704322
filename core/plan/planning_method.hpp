#pragma once
/// The planning methods: one row each, with its name, its planner and what it limits. To add one, add a row.
#include <cstddef>

#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/method_options.hpp"

namespace bahnwerk {

class Progress;

struct MethodResult {
  TimeLaw law;
  std::size_t iterations = 0;  ///< passes of the planner over its grid
  std::size_t cells = 0;
};

struct MethodRow {
  PlanningMethod method;
  /// The law of the whole path, without its dwells. `refinement` 0, 1 …: each on a grid half as wide as the one before,
  /// with a tenth of its loss. Throws as the planner does.
  MethodResult (*plan)(const PathTask& task, const MethodOptions& options, int refinement, Progress& progress,
                       double from, double to);
  /// Jerk limits of the axes hold, and that along the path; the motion's acceleration is continuous.
  bool limits_jerk;
  /// Limits along the path hold.
  bool limits_along;
  /// Its options' profile decides whether jerk is limited.
  bool takes_profile;
  /// Its law tends to the proven bound as the grid is refined: worth while until it is there.
  bool reaches_bound;
  /// Its changes of speed hold limits at the nodes of a grid. What they exceed between, on the finest grid, slows them.
  bool holds_at_nodes;
};

/// Throws std::logic_error for a method without a row.
const MethodRow& method_row(PlanningMethod method);
/// The row with what these options make of it: a profile whose acceleration jumps limits no jerk.
MethodRow method_row(PlanningMethod method, const MethodOptions& options);

/// The limits that a method holds, of the machine's first `axes`: jerk is unlimited where it is not among them.
Machine held_limits(Machine machine, const MethodRow& method, std::size_t axes);

}  // namespace bahnwerk
