#pragma once
/// States (position, velocity) that an axis can be in: an enclosure of all that lead there within limits.
///
/// A convex polygon that holds every reachable state. The axis' acceleration is any function of time with |a| ≤ 1
/// (units are the caller's), not one that is constant over a step: what a step of h adds to a state is a lens between
/// (±h²/2, ±h), and the polygon takes up the hexagon around it that touches it at both ends and in its middle. Limits
/// are widened by 1e-9, more than all rounding does; an empty polygon therefore proves that no motion exists.
#include <cstddef>
#include <vector>

namespace bahnwerk {

class ReachableStates {
 public:
  /// Returns all states of a box; both ranges are widened as above.
  static ReachableStates box(double lowest, double highest, double velocity);

  bool empty() const { return vertices_.size() < 3; }
  bool holds(double x, double v) const;
  /// Moves the states on by h units of time, with velocities within their limit all the time. O(vertices); beyond 128
  /// of them some edges give way, outwards.
  void advance(double h, double velocity, double acceleration = 1);
  /// Moves the states on by h units of time without any acceleration.
  void coast(double h);
  /// Only those with lowest ≤ x ≤ highest and |v| ≤ velocity remain.
  void limit(double lowest, double highest, double velocity);
  /// Adds at least those whose velocity is up to `factor` times as large or as small, factor ≥ 1.
  void scale_velocity(double factor);
  /// Returns the states in time that runs backwards.
  ReachableStates reversed() const;
  /// Returns (x, 0) minus each state.
  ReachableStates subtracted_from(double x) const;
  /// Returns the sums of a state of either.
  ReachableStates plus(const ReachableStates& other) const;
  /// Only those that are among the others, too, remain.
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
