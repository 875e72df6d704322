#pragma once
/// How long a machine takes along pieces of a needle's path: by limited jerk, from rest to rest.
#include <cstddef>
#include <memory>
#include <span>

#include "core/geometry/spline/bezier_piece.hpp"
#include "core/machine/kinematics.hpp"

namespace bahnwerk {

class Progress;

class LinkTimer {
 public:
  /// `machine` and `progress` outlive it. `along`: limits of the tip along its path; `cycle_time`: of the setpoints, s.
  LinkTimer(const Kinematics& machine, const Limits& along, double cycle_time, Progress& progress)
      : machine_(machine), along_(along), cycle_time_(cycle_time), progress_(progress) {}

  /// On a coarse grid, some 3e-3 above what exact() gives: 3 to 6 ms of a slot, a link and a head. Infinite where a
  /// pose is out of reach, and where the planner takes far longer than usual, which only links with sharp bends do.
  double operator()(std::span<const BezierPiece> pieces) const;
  /// As a plan takes, whatever the effort; infinite out of reach. 10 to 30 ms per link.
  double exact(std::span<const BezierPiece> pieces) const;

 private:
  double timed(std::span<const BezierPiece> pieces, bool coarse) const;

  const Kinematics& machine_;
  Limits along_;
  double cycle_time_;
  Progress& progress_;
};

}  // namespace bahnwerk
