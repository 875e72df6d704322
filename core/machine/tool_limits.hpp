#pragma once
/// What the limits of a machine's axes let its tool do at one place. Rounding takes its lengths from these figures.
#include <functional>
#include <utility>

#include "core/geometry/curve/curve.hpp"
#include "core/machine/kinematics.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

/// mm, s. On a Cartesian machine: the diagonals of the box of limits, and its shortest sides.
struct ToolLimits {
  double speed = 0;         ///< no direction allows more
  double acceleration = 0;  ///< every direction allows as much
  double jerk = 0;          ///< every direction allows as much
  double pull = 0;          ///< no direction allows more acceleration
};

/// Returns the limits of a machine whose axes are coordinates of the tool.
ToolLimits tool_limits(const Machine& cartesian);

/// Returns the limits at a position. With the Jacobian J of the axes by the first `coordinates` coordinates, every
/// direction allows min_k A_k/|J_k| (rows of J), and none more than the norm of Σ_k |J⁺_ik| A_k, i = 1 …, by the
/// pseudo-inverse J⁺. The change of J along the path is not counted. Throws UnreachablePose.
ToolLimits tool_limits(const Kinematics& kinematics, const Machine& limits, std::size_t coordinates, Vec position);

/// The limits of the tool everywhere, and the controller's cycle.
class ToolLimitsMap {
 public:
  /// Limits that are equal everywhere.
  ToolLimitsMap(const Machine& cartesian)  // NOLINT: implicit, a Cartesian machine is such a map
      : cycle_time(cartesian.cycle_time), equal_(tool_limits(cartesian)) {}
  ToolLimitsMap(std::function<ToolLimits(Vec)> at, double cycle) : cycle_time(cycle), at_(std::move(at)) {}
  /// Returns the limits at the position that `position()` returns; it is asked where limits depend on it.
  template <class Position>
  ToolLimits at(Position&& position) const {
    return at_ ? at_(position()) : equal_;
  }

  double cycle_time;  ///< s

 private:
  ToolLimits equal_;
  std::function<ToolLimits(Vec)> at_;
};

}  // namespace bahnwerk
