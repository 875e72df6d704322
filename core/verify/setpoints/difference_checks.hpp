#pragma once
/// Checks differences of the setpoints from row to row against the motion's limits.
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

/// Inputs of the check. The objects referred to have to outlive it.
struct DifferenceInput {
  const SetpointSource& setpoints;  ///< has a column for every axis, and s
  const Machine& machine;
  std::vector<double> shown;  ///< factor from each axis' unit to that of its column
  /// The verdict on the motion from which the rows were taken; its limits apply to the rows, too. It has to be complete
  /// when the check is made.
  const Verification& motion;
  /// Rounding error of positions, in their column's unit; a difference of order n has 2ⁿ times that error.
  double rounding = 0;
  /// Fraction by which the speed along the path may exceed its limit: the stated accuracy of an interpolator's feed.
  double feed_tolerance = 0;
};

/// Returns for every check `velocity <axis>`, `acceleration <axis>`, `jerk <axis>`, `path velocity`, `path
/// acceleration`, `path jerk` in `motion` one named `setpoint <check>`, with its limit and unit: the largest first,
/// second or third difference of consecutive rows' positions, divided by the cycle time to the first, second or third
/// power. That is the mean of the derivative over one, two or three cycles: rows taken exactly from a motion keep its
/// limits (mean value theorem). The check is therefore for rows of an interpolator, which the motion's peaks do not
/// cover, and for paths whose joints let the acceleration step. value ≤ limit · (1 + 1e-9); missing columns and values
/// that are not numbers fail. `at` is the middle of the rows. 0.05 µs per row.
std::unique_ptr<RowCheck> difference_row_check(const DifferenceInput& input);

/// Returns the results after reading all rows for this check alone.
std::vector<Check> difference_checks(const DifferenceInput& input, Progress progress);

}  // namespace bahnwerk
