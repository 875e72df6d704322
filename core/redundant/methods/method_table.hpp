#pragma once
/// The methods that plan a machine with coarse and fine axes: one row each, from the same task to the same result. To
/// add one, write a function `RedundancyResult plan(task, options, progress, from, to)` and enter it in
/// method_table.cpp.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

struct RedundancyRow {
  RedundancyMethod method;
  /// Throws InvalidInput, Infeasible, Stopped.
  RedundancyResult (*plan)(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                           double from, double to);
  bool limits_jerk;  ///< jerk limits of both axes hold where they are given
};

/// The note of a plan that was made from the contour's end to its begin.
inline constexpr const char* backwards_note = "planned from its end to its begin, which is quicker here";

/// Throws std::logic_error for a method without a row.
const RedundancyRow& redundancy_row(RedundancyMethod method);

/// Tells whether the coarse axes alone take the place of a method that finds no motion, as they do where its motion is
/// slower than theirs: along a lone straight move, on which a little more or less stroke decides whether `geometric`,
/// `filter`, `follow_up` and `lag_compensation` find one. So no such move takes longer with more stroke.
bool gantry_takes_over(const RedundancyTask& task, RedundancyMethod method);

/// Plans with the row of `options.method`, and times the motion again if `options.reparametrise` says so (without
/// limited jerk). Where an axis has no fine one the joint planner takes the place of every other method, which
/// `gave_way` tells, and a note. Where the coarse axes alone are quicker than any method but `joint`, which knows of
/// them, they move alone (without limited jerk); `gave_way` tells it. Where the bound leaves more than 5e-4 open the
/// task is planned from its end to its begin, too, unless the method is the same in both directions or none (a lag's):
/// the quicker one counts. A task without a bound is planned in the direction of time alone.
RedundancyResult plan_redundant(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                double from = 0, double to = 1);

}  // namespace bahnwerk
