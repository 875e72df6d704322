#pragma once
/// Slows motions to whole cycles of the controller, so that the last setpoint is their end.
#include <cstddef>

namespace bahnwerk {

/// Number of cycles of a motion, and the factor (≥ 1) by which it is slowed to end exactly on the last one.
struct Cycles {
  std::size_t count = 0;  ///< setpoints = count + 1
  double factor = 1;
};
/// Returns the least number of cycles, at least one, that `duration` fits into, and the factor by which the motion is
/// slowed to last so many. Both arguments in s.
Cycles whole_cycles(double duration, double cycle_time);

}  // namespace bahnwerk
