#pragma once
/// What the setpoints themselves ask of the axes: differences from row to row, held to the motion's limits.
#include <memory>
#include <vector>

#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

class Progress;

struct DifferenceInput {
  const SetpointSource& setpoints;  ///< columns of every axis' name, and s
  const Machine& machine;
  std::vector<double> shown;  ///< per axis: what one of its units is in its column
  /// The verdict on the motion that the rows were taken from: what it is held to, the rows are, too. It has to be known
  /// when the check is made.
  const Verification& motion;
  /// By how much positions may be off by rounding, in their column's unit: a difference of order n is off by 2ⁿ of it.
  double rounding = 0;
  /// A fraction by which the speed along the path may exceed its limit: what is stated of an interpolator's feed.
  double feed_tolerance = 0;
};

/// Of every check `velocity <axis>`, `acceleration <axis>`, `jerk <axis>`, `path velocity`, `path acceleration`, `path
/// jerk` in `motion` one named `setpoint <check>`, with its limit and unit: the largest first, second or third
/// difference of consecutive rows' positions, divided by the cycle time to the first, second or third power. That is
/// the mean of the derivative over one, two or three cycles: rows taken exactly from a motion keep what the motion
/// keeps (mean value theorem), so this is for rows that an interpolator puts a little off it, where the motion's own
/// peaks say nothing, and for paths whose joints let the acceleration step. value ≤ limit · (1 + 1e-9); missing columns
/// and what is not a number fail. `at` is the middle of the rows. 0.05 µs per row.
std::unique_ptr<RowCheck> difference_row_check(const DifferenceInput& input);

/// Reads all rows for that check alone.
std::vector<Check> difference_checks(const DifferenceInput& input, Progress& progress);

}  // namespace bahnwerk
