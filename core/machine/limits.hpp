#pragma once
/// What one axis, or the tool along its path, may do.
#include <limits>

namespace bahnwerk {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Magnitudes in the axis' unit (mm for a linear axis, rad for a rotary one) and s; infinite = not limited.
struct Limits {
  double velocity = unlimited;                      ///< unit/s
  double acceleration = unlimited;                  ///< unit/s²
  double jerk = unlimited;                          ///< unit/s³
  double snap = unlimited;                          ///< unit/s⁴
  double lowest = -unlimited, highest = unlimited;  ///< range of positions, unit; along a path without meaning
};

}  // namespace bahnwerk
