#pragma once
/// Outer approximation of the reachable set of an axis: a convex polygon that contains all states (position, velocity)
/// that the axis can be in.
///
/// The acceleration is an arbitrary function of time with |a| ≤ 1 (in units of the caller), not constant over a step.
/// The set of changes of state during a step h is a lens between (±h²/2, ±h); the polygon is enlarged by a hexagon that
/// contains the lens and touches it at both ends and in its middle. Limits are widened by 1e-9, which exceeds all
/// rounding errors. An empty polygon therefore proves that no motion exists. (The planner's inner approximation is
/// core/redundant/chain/controllable_set.hpp.)
#include <cstddef>
#include <vector>

namespace bahnwerk {

class ReachableStates {
 public:
  /// Returns the states with lowest ≤ x ≤ highest and |v| ≤ velocity, widened as above.
  static ReachableStates box(double lowest, double highest, double velocity);

  bool empty() const { return vertices_.size() < 3; }
  bool holds(double x, double v) const;
  /// Carries the set forward by h units of time, with velocities within their limit all the time. O(vertices); beyond
  /// 128 vertices some edges are removed, which enlarges the set.
  void advance(double h, double velocity, double acceleration = 1);
  /// Carries the set forward by h units of time without acceleration.
  void coast(double h);
  /// Intersects the set with lowest ≤ x ≤ highest and |v| ≤ velocity.
  void limit(double lowest, double highest, double velocity);
  /// Enlarges the set by, at least, all states whose velocity is up to `factor` ≥ 1 times as large or as small.
  void scale_velocity(double factor);
  /// Returns the set for reversed time: velocities change their sign.
  ReachableStates reversed() const;
  /// Returns the set of (x, 0) minus each state.
  ReachableStates subtracted_from(double x) const;
  /// Returns the Minkowski sum of both sets.
  ReachableStates plus(const ReachableStates& other) const;
  /// Intersects the set with another one.
  void limit(const ReachableStates& other);

 private:
  struct State {
    double x = 0, v = 0;
  };
  void add_segment(State g);
  void cut(double x, double v, double most);
  void simplify();

  std::vector<State> vertices_, spare_;  ///< counter-clockwise
};

}  // namespace bahnwerk
