#pragma once
/// A lower bound, in closed form, of the time that a contour takes with stops at its corners. It shows where rounding
/// is certainly quicker without planning the motion with stops.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"

namespace bahnwerk {

/// A bound that is weaker than that of core/verify/bound but computed a hundred times as quickly.
///
/// A single line between two stops has its exact least time. Otherwise the speed stays below F, given by the feed, the
/// axes and, on arcs, the centripetal acceleration, which costs at least ∫ ds/F. Additional time is lost near each
/// place of low speed w (w = 0 at a stop; at a joint the acceleration of an axis may jump by at most jerk · cycle). The
/// loss 1 − v/F is integrated over ±τ with
///   v ≤ w + |A| t for |v̇| ≤ |A|,
///   v(t) + v(−t) ≤ 2 w + J t², and v(t) ≤ J t²/2 at a stop, for |v̈| ≤ |J| + κ²F³ (since q⃛ · t = v̈ − κ²v³).
/// τ is half of the least time on the segments beside the place, so no two places share any time.
class StoppingTime {
 public:
  /// `axes` are the moving axes of the contour, `machine` the limits that the method keeps, `corner_angle` is in rad.
  /// All arguments must outlive this object.
  StoppingTime(const Contour& contour, const AxisPath& axes, const Machine& machine, double corner_angle);

  /// Returns the bound for segments [first, last), at rest at both ends, s; without dwells; 0 if the axes are not
  /// coordinates of the tool. O(segments), 50 to 200 ns each.
  double least(std::size_t first, std::size_t last, ProgressScope& progress) const;
  /// Tells whether the motion rests at the begin of segment i, for instance at a corner.
  bool rests(std::size_t i) const;

 private:
  /// Limits of the motion along a segment, and the time at the largest speed, s.
  struct Limit : Limits {
    double time = 0;
  };
  Limit limit(std::size_t segment) const;
  double joint_speed(std::size_t next) const;
  double between_stops(std::size_t first, std::size_t last, ProgressScope& progress) const;

  const Contour& contour_;
  const AxisPath& axes_;
  const Machine& machine_;
  double corner_angle_;
  std::vector<double> feeds_;
  std::vector<bool> rests_;
  Limits together_;  // limits of all axes together
};

}  // namespace bahnwerk
