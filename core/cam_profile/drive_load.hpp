#pragma once
/// What a drive has to bring about for a law: force or torque, speed and power over one cycle.
///
/// F = A s″ + D s′ + C s + F₀ + R sign(s′), linear in the law but for friction. Friction acts where the slave moves,
/// |s′| above 1e-9 of its peak; at rest it counts as 0, and where a motion begins it counts with its full value.
#include <vector>

#include "core/cam_profile/cam_figures.hpp"
#include "core/cam_profile/given_drive.hpp"

namespace bahnwerk::cam {

/// The load at the drive, per unit of the law.
struct LinearLoad {
  double acceleration = 0, velocity = 0, position = 0, constant = 0;
  double friction = 0;  ///< R ≥ 0
  double speed = 0;     ///< speed of the drive per unit/s
  double power = 0;     ///< W per unit of force and unit/s
};
LinearLoad linear_load(const DriveLoad& load);

/// Returns the accelerations, unit/s², that a peak force or torque leaves: |A a + F₀| + R ≤ peak. Friction counts with
/// its full value against either sign: the sign of s′ is not known before the law is. Exact for a load without spring,
/// damping and friction. An empty range if nothing is left.
Range acceleration_within(const LinearLoad& load, double peak);

struct LoadPoint {
  double at = 0;  ///< rad, of the cycle
  double effort = 0, speed = 0, power = 0;
};
struct LoadFigures {
  CamExtreme most, least;              ///< proven extremes of the force or torque, signed
  CamExtreme most_power, least_power;  ///< W; proven
  double rms = 0;                      ///< root of the mean square over the cycle
  double mean_power = 0;               ///< W
  std::vector<LoadPoint> points;       ///< at each break, and between breaks at equal steps, 360 or more per cycle
  double peak() const { return std::max(most.value, -least.value); }
};
/// Means by Gauss' rule with 24 points in parts in which the slave does not turn back: exact for polynomials.
LoadFigures load_figures(const LinearLoad& load, const CamLaw& law, Progress progress);

}  // namespace bahnwerk::cam
