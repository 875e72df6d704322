#pragma once
/// The verdict on a plan: the checks of the independent verifier and the proven bound.
#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bahnwerk {

/// What a check is about: a limit of the document, the path or layout, the motion with its rests, the rows of the
/// series, the bound.
enum class CheckGroup { limit, geometry, continuity, setpoints, bound };

/// The quantity that a check compares: a constant of the code that compares it, so that a new one concerns no other.
struct Quantity {
  /// In it "%" stands for the derivative that the check's order names, "#" for its limit. Empty: the subject is the
  /// whole name.
  std::string_view name = {};
  CheckGroup group = CheckGroup::limit;
  bool each = false;  ///< whether each of several subjects (axes, layouts) has such a check
  bool operator==(const Quantity&) const = default;
};

/// Quantities that are compared in several places.
namespace quantity {
inline constexpr Quantity axis{"%", CheckGroup::limit, true};  ///< an axis' range (order 0), or its derivative
inline constexpr Quantity path{"path %"};                      ///< the derivative along the tool's path
/// The speed along the path in blocks of one feed, which is the limit.
inline constexpr Quantity feed{"path % (feed #)"};
/// The step of an axis' derivative where segments meet.
inline constexpr Quantity joint_step{"% step at joints", CheckGroup::continuity};
inline constexpr Quantity start_rest{"start at rest", CheckGroup::continuity};  ///< the speed at the beginning
inline constexpr Quantity end_rest{"end at rest", CheckGroup::continuity};      ///< the speed at the end
/// The step of a derivative where pieces of the motion meet.
inline constexpr Quantity continuity{"continuity of %", CheckGroup::continuity};
inline constexpr Quantity rows_count{"setpoints count", CheckGroup::setpoints};  ///< number, presence of all columns
inline constexpr Quantity rows_time{"setpoints time", CheckGroup::setpoints};    ///< the time span of the rows
inline constexpr Quantity rows{"setpoints %", CheckGroup::setpoints};            ///< columns of positions, derivatives
inline constexpr Quantity rows_end{"setpoints end", CheckGroup::setpoints};      ///< the last row
inline constexpr Quantity rows_pose{"setpoints pose", CheckGroup::setpoints};    ///< columns of the pose
/// Forward kinematics of the rows against the path.
inline constexpr Quantity tip_position{"forward kinematics %", CheckGroup::geometry};
}  // namespace quantity

/// The compared quantity and its unit, as data; api/check_text.hpp makes the texts for people.
struct Checked {
  Quantity quantity = {};
  int order = 0;             ///< 0 position, 1 velocity, 2 acceleration, 3 jerk, 4 snap
  std::string unit = "mm";   ///< unit of the quantity at order 0; api appends /s, /s² …
  std::string subject = {};  ///< the axis, the group of axes, or the layout that is checked; empty: everything
};

/// Returns what a check compares that has a name of its own, with its whole unit.
inline Checked named(CheckGroup group, std::string name, std::string unit) {
  return {{{}, group}, 0, std::move(unit), std::move(name)};
}

/// A comparison by the verifier: the true continuous peak of a quantity against its limit.
struct Check : Checked {
  double limit = 0;  ///< the limit in the unit of the order (mm/s for order 1), like `value`
  double value = 0;  ///< largest (or smallest) value of the quantity
  double at = 0;     ///< s, where that value occurs
  bool passed = false;
};

/// Returns whether `check` has that quantity, order and subject.
inline bool is(const Check& check, const Quantity& quantity, int order, const std::string& subject = {}) {
  return check.quantity == quantity && check.order == order && check.subject == subject;
}

/// Returns whether a slower motion has a smaller value: derivatives of axes and along the path, and steps of them.
inline bool falls_with_speed(const Check& check) {
  const Quantity& q = check.quantity;
  return check.order > 0 &&
         (q == quantity::axis || q == quantity::path || q == quantity::feed || q == quantity::joint_step);
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
  const Check* find(const Quantity& quantity, int order, const std::string& subject = {}) const {
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
