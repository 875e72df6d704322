#pragma once
/// What a user gives of the drive and of what it moves.
#include <limits>

namespace bahnwerk::cam {

/// F = J s″ + D s′ + C (s − s₀) + F₀ + R sign(s′) at the slave. A linear slave (mm): kg, N, N/mm, N s/mm; a rotary one
/// (deg): kg m², N m, N m/deg, N m s/deg.
struct DriveLoad {
  bool rotary = false;
  double inertia = 0, force = 0, spring = 0, spring_zero = 0, damping = 0, friction = 0;
  /// Motor turns per turn of a rotary slave; travel of a linear one per turn of the motor, mm. 0: a direct drive.
  double ratio = 0;
  double motor_inertia = 0;  ///< kg m²

  /// Whether the drive brings about a torque, N m, at a speed in 1/min; else a force, N, at mm/s.
  bool turns() const { return rotary || ratio > 0; }
};

/// Limits of the drive; infinite where there is none.
struct LoadLimits {
  double peak = std::numeric_limits<double>::infinity();  ///< largest |force|, N, or |torque|, N m
  double rms = std::numeric_limits<double>::infinity();   ///< largest root mean square over the cycle
};

}  // namespace bahnwerk::cam
