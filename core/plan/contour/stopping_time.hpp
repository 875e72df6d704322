#pragma once
/// How long a contour takes at least if the motion stops at its corners: closed form, to tell where rounding them has
/// certainly paid without planning the other motion.
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/path_task.hpp"

namespace bahnwerk {

/// A bound, looser than core/verify/bound and a hundred times as quick, of what follows a contour as it is.
///
/// A single line between two stops: exactly what it takes. Else speed stays below F, by the feed, the axes and, on
/// arcs, the centripetal acceleration; that alone costs ∫ ds/F. From what 1 − v/F loses about a place of speed w (a
/// stop: w = 0; a joint that the acceleration of an axis may step at by jerk · cycle only) within ±τ:
///   speed v with |v̇| ≤ |A|: v ≤ w + |A| t,
///   with |v̈| ≤ |J| + κ²F³, because q⃛ · t = v̈ − κ²v³: v(t) + v(−t) ≤ 2 w + J t², and at a stop v(t) ≤ J t²/2;
/// τ is half of the least time on the segments beside the place, so no two places share any time.
class StoppingTime {
 public:
  /// `axes`: those of the contour that move, with the limits that are held. `corner_angle` rad. All outlive it.
  StoppingTime(const Contour& contour, const AxisPath& axes, const Machine& machine, double corner_angle);

  /// Returns the bound for segments [first, last), at rest at both ends, s; without dwells. O(segments), 50 to 200 ns
  /// each.
  double least(std::size_t first, std::size_t last, ProgressScope& progress) const;
  /// Whether the motion rests where segment i begins, at a corner for one.
  bool rests(std::size_t i) const;

 private:
  /// What bounds the motion on a segment.
  struct Limit {
    double speed = 0, acceleration = 0, jerk = 0;
    double time = 0;  ///< length / speed
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
  double speed_, acceleration_, jerk_;  // of all axes together
};

}  // namespace bahnwerk
