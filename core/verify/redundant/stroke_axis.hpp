#pragma once
/// Which states the coarse axis of a coordinate can be in where the head rests, so far as its own limits, those of the
/// fine axis and what the head can do within a given time say (stroke_bound.hpp).
#include <cstddef>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/verify/redundant/head_reach.hpp"
#include "core/verify/redundant/reachable_states.hpp"

namespace bahnwerk::verify {

/// One or more sections: where they lead from and to, and how far from either end the head may be.
struct Passage {
  AxisJet begin, end;
  HeadReach forward, backward;
  /// Returns the passage in time that runs backwards.
  Passage reversed() const { return {end, begin, backward, forward}; }
};

/// Axis `index` of the path, in units of its stroke and of √(stroke/acceleration), places from `origin`, mm. Times are
/// given in s.
class StrokeAxis {
 public:
  StrokeAxis(const AxisLimits& coarse, const AxisLimits& fine, std::size_t index, double origin);

  double unit() const { return time_; }  ///< s
  /// Returns how long before a rest, s, motion has a say in the states at it.
  double horizon() const;

  /// Returns the states in which the coarse axis can be at a rest, if the head was on `reach` before. `rests`: it
  /// begins there.
  ReachableStates before(const HeadReach& reach, bool rests) const;
  /// Returns the states in which the coarse axis may be at the end of a passage that takes `duration`, from those at
  /// its begin; empty: there is no motion. O(duration).
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
