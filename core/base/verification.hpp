#pragma once
/// The verdict on a plan: the checks of the independent verifier and the proven bound.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace bahnwerk {

/// The quantity that a check compares. Where an order is named, the check's `order` is the derivative.
enum class CheckedQuantity {
  named,             ///< a quantity that one kind alone checks: `subject` is its name, `unit` the whole unit
  axis,              ///< an axis' range (order 0), or its derivative
  path,              ///< the derivative along the tool's path
  feed,              ///< the speed along the path in blocks of one feed, which is the limit
  joint_step,        ///< the step of an axis' derivative where segments meet
  corner_rest,       ///< the speed in corners and at rests
  cusp_rest,         ///< the speed in cusps
  start_rest,        ///< the speed at the beginning
  end_rest,          ///< the speed at the end
  continuity,        ///< the step of a derivative where pieces of the motion meet
  time_continuity,   ///< the gap in time where pieces meet
  duration,          ///< equal durations of motions
  bound,             ///< a plan is not better than its bound
  segments,          ///< pieces stay in their segments
  forward,           ///< the motion never moves backwards
  coverage,          ///< the whole path is driven
  path_distance,     ///< distance of the law's places from the path
  arc_length,        ///< two quadratures agree
  block_order,       ///< blocks are those of the contour
  deviation,         ///< distance of the path from the contour
  dwell,             ///< duration of a requested rest
  stroke,            ///< the position of a fine axis
  centred_start,     ///< a fine axis' position at the beginning
  centred_end,       ///< a fine axis' position at the end
  chord_error,       ///< distance of the chord between rows from the path
  half_speed_feed,   ///< the speed in curves
  tip_position,      ///< forward kinematics of the rows against the path
  tip_angle,         ///< direction by forward kinematics against the path
  clearance,         ///< the tool's distance from obstacles: at least the limit
  pull,              ///< the pull of the wire
  slack,             ///< the least pull: at least the limit
  wire_overlap,      ///< overlap of wires beyond the allowed one
  boundary_overlap,  ///< overlap of wires with the slot's boundary
  wires_missing,     ///< the count of wires against the stated one
  rows_count,        ///< the number of rows, and presence of all columns
  rows_time,         ///< the time span of the rows
  rows_path,         ///< column s
  rows_speed,        ///< column v
  rows_forward,      ///< s never decreases
  rows,              ///< columns of positions (order 0) and derivatives
  rows_end,          ///< the last row
  rows_end_rest,     ///< the last row's speeds
  rows_labels,       ///< mode and block
  rows_sum,          ///< coarse + fine = head, per order
  rows_stroke,       ///< fine positions
  rows_fine,         ///< fine derivatives
  rows_pose,         ///< columns of the pose
  axis_differences,  ///< differences of an axis' rows over the cycle time, by order
  path_differences,  ///< differences of s
};

/// The compared quantity and its unit, as data; api/check_text.hpp makes the texts for people.
struct Checked {
  CheckedQuantity quantity = CheckedQuantity::named;
  int order = 0;             ///< 0 position, 1 velocity, 2 acceleration, 3 jerk, 4 snap
  std::string unit = "mm";   ///< unit of the quantity at order 0; api appends /s, /s² …
  std::string subject = {};  ///< the axis, the group of axes, or the layout that is checked; empty: everything
};

/// A comparison by the verifier: the true continuous peak of a quantity against its limit.
struct Check : Checked {
  double limit = 0;  ///< the limit in the unit of the order (mm/s for order 1), like `value`
  double value = 0;  ///< largest (or smallest) value of the quantity
  double at = 0;     ///< s, where that value occurs
  bool passed = false;
};

/// Returns whether `check` has that quantity, order and subject.
inline bool is(const Check& check, CheckedQuantity quantity, int order, const std::string& subject = {}) {
  return check.quantity == quantity && check.order == order && check.subject == subject;
}

/// Returns whether a slower motion has a smaller value: derivatives of axes and along the path, and steps of them.
inline bool falls_with_speed(const Check& check) {
  const CheckedQuantity q = check.quantity;
  return check.order > 0 && (q == CheckedQuantity::axis || q == CheckedQuantity::path || q == CheckedQuantity::feed ||
                             q == CheckedQuantity::joint_step);
}

/// An excess of a limit that a slower motion does not have.
struct TooFast {
  double at = 0;      ///< s
  double factor = 1;  ///< a motion that lasts this many times as long keeps the limit
};

/// The verdict on a plan.
struct Verification {
  bool passed = false;
  std::vector<Check> checks;
  /// Excesses of axes: one per motion between two rests, that of the axis with the largest factor.
  std::vector<TooFast> too_fast;
  /// Appends a check.
  void add(Check check) {
    passed = passed && check.passed;
    checks.push_back(std::move(check));
  }
  void add(std::vector<Check> more) {
    for (Check& check : more) add(std::move(check));
  }
  /// Returns the check of that quantity, order and subject; nullptr if there is none.
  const Check* find(CheckedQuantity quantity, int order, const std::string& subject = {}) const {
    const auto at = std::find_if(checks.begin(), checks.end(),
                                 [&](const Check& check) { return is(check, quantity, order, subject); });
    return at == checks.end() ? nullptr : &*at;
  }
};

/// The bounded quantity: a duration (s), a count, or a kind's own objective.
enum class BoundQuantity { duration, count, objective };
/// lower: no solution is below the bound. upper: no solution is above it.
enum class BoundSense { lower, upper };

/// A bound on every solution of the task.
struct Bound {
  double value = 0;   ///< no solution within the given limits is better
  double gap = 0;     ///< fraction by which the planned solution is worse
  std::string basis;  ///< method that proves the bound, for people
  BoundQuantity quantity = BoundQuantity::duration;
  BoundSense sense = BoundSense::lower;
  std::string unit = "s";
};

/// Returns the bound with its gap to the planned value: planned / value − 1, for an upper bound value / planned − 1; 0
/// where the divisor is not positive, and where the plan is better by 1e-14, which is rounding.
Bound with_gap(Bound bound, double planned);

}  // namespace bahnwerk
