#pragma once
/// Table of the planning methods: each row has the method's name, planner and properties. A new method is one more row.
#include <cstddef>

#include "core/base/progress.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/plan/method_options.hpp"

namespace bahnwerk {

struct MethodResult {
  TimeLaw law;
  std::size_t iterations = 0;  ///< passes of the planner over its grid
  std::size_t cells = 0;
};

/// Whether finer grids are planned although the verifier asks for none.
enum class Refinement {
  none,
  to_bound,  ///< until the duration, which converges to its proven bound, is near it
  /// Until the duration hardly changes. The finer law is kept even if it takes longer, because between the nodes of a
  /// coarse grid a law may use part of its reserve.
  to_steady
};

struct MethodRow {
  PlanningMethod method;
  /// Returns the time law of the whole path without dwells. Each `refinement` 0, 1 … halves the cell width and reduces
  /// the excess over the optimum to about a tenth. Throws as the planner does.
  MethodResult (*plan)(const PathTask& task, const MethodOptions& options, int refinement, Progress progress);
  /// Highest derivative whose limits hold, of the axes and along the path: 2 (acceleration) or 3 (jerk). The next lower
  /// one is continuous.
  int order;
  /// Whether limits along the path hold.
  bool limits_along;
  /// Whether the option `profile` decides on the order.
  bool takes_profile;
  Refinement refinement;
  /// Whether changes of speed keep the limits at the nodes of a grid only; an excess between nodes, on the finest grid,
  /// slows them.
  bool holds_at_nodes;
};

/// Returns a method's row with these options: a profile whose acceleration jumps has the order 2. Throws
/// std::logic_error for a method without a row.
MethodRow method_row(PlanningMethod method, const MethodOptions& options = {});

/// Returns the limits that a method keeps: what is above its order is unlimited.
Machine held_limits(Machine machine, const MethodRow& method);

}  // namespace bahnwerk
