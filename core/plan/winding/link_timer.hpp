#pragma once
/// The time that a machine takes along pieces of a needle's path, from rest to rest with limited jerk.
#include <cstddef>
#include <memory>
#include <span>

#include "core/base/progress.hpp"
#include "core/geometry/spline/bezier_piece.hpp"
#include "core/machine/kinematics.hpp"

namespace bahnwerk {

class LinkTimer {
 public:
  /// `machine` and `progress` must outlive this object. `along` are limits of the tip along its path; `cycle_time` is
  /// that of the setpoints, s.
  LinkTimer(const Kinematics& machine, const Limits& along, double cycle_time, Progress progress)
      : machine_(machine), along_(along), cycle_time_(cycle_time), progress_(progress) {}

  /// Returns the time, s, on a coarse grid: relatively about 3e-3 above exact(). It takes 3 to 6 ms for a slot, a link
  /// and a head. Infinite if a pose is out of reach, or if the planner takes far longer than usual, which only happens
  /// for links with sharp bends.
  double operator()(std::span<const BezierPiece> pieces) const;
  /// Returns the time, s, as in a plan; infinite if a pose is out of reach. It takes 10 to 30 ms per link.
  double exact(std::span<const BezierPiece> pieces) const;

 private:
  double timed(std::span<const BezierPiece> pieces, bool coarse) const;

  const Kinematics& machine_;
  Limits along_;
  double cycle_time_;
  Progress progress_;
};

}  // namespace bahnwerk
