#pragma once
/// Enclosures of the states that the coarse axis of one coordinate can have where the head rests. They follow from its
/// own limits, those of the fine axis, and the places that the head can reach within a given time (stroke_bound.hpp).
#include <cstddef>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/verify/redundant/head_reach.hpp"
#include "core/verify/redundant/reachable_states.hpp"

namespace bahnwerk::verify {

/// One or more consecutive sections: the axes' positions at both ends, and the head's reach from both ends.
struct Passage {
  AxisJet begin, end;
  HeadReach forward, backward;
  /// Returns the passage in reversed time.
  Passage reversed() const { return {end, begin, backward, forward}; }
};

/// Axis `index` of the path in dimensionless units: lengths by its stroke, counted from `origin` (mm), times by
/// √(stroke/acceleration). Arguments that are times are in s.
class StrokeAxis {
 public:
  StrokeAxis(const AxisLimits& coarse, const AxisLimits& fine, std::size_t index, double origin);

  double unit() const { return time_; }  ///< s
  /// Returns the time before a rest, s, beyond which earlier motion does not restrict the states at the rest.
  double horizon() const;

  /// Returns the states that the coarse axis can have at a rest, if the head was within `reach` before. `rests`: the
  /// axis begins at rest there.
  ReachableStates before(const HeadReach& reach, bool rests) const;
  /// Returns the states that the coarse axis can have at the end of a passage of `duration` s that begins in one of
  /// `begin`; an empty set proves that no motion exists. O(duration).
  ReachableStates pass(const ReachableStates& begin, const Passage& passage, double duration) const;

 private:
  double low(const AxisReach& r) const;
  double high(const AxisReach& r) const;
  ReachableStates box(const AxisReach& r, double velocity) const;
  void limit(ReachableStates& states, const AxisReach& r, double velocity) const;

  std::size_t index_;
  double stroke_, time_, velocity_, fine_velocity_, fine_acceleration_, at_rest_, origin_, lowest_, highest_;
};

}  // namespace bahnwerk::verify
