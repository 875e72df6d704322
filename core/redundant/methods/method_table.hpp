#pragma once
/// The methods that plan a machine with coarse and fine axes: one row each, from the same task to the same result. To
/// add one, write a function with the signature of RedundancyRow::plan and enter it in method_table.cpp.
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

struct RedundancyRow {
  RedundancyMethod method;
  /// Returns the plan, or why there is none; it plans by itself, without another method. Throws InvalidInput, Stopped.
  Expected<RedundancyResult, NoPlan> (*plan)(const RedundancyTask& task, const RedundancyOptions& options,
                                             Progress progress);
  int order;        ///< highest derivative whose limits hold for both axes: 2 (acceleration) or 3 (jerk)
  bool every_axis;  ///< every coordinate has to have a fine axis
  bool centres;     ///< fine axes can be made to stand in the middle of their strokes at both ends
  bool either_way;  ///< planning the reversed contour can change the duration, and its plan is one of the contour
};

/// Throws std::logic_error for a method without a row.
const RedundancyRow& redundancy_row(RedundancyMethod method);

}  // namespace bahnwerk
