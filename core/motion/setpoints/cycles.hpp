#pragma once
/// Motions last whole cycles of the controller, so that the last setpoint is their end.
#include <cstddef>

namespace bahnwerk {

/// How many cycles a motion of `duration` takes and by what factor (≥ 1) it is slowed to end exactly on the last one.
struct Cycles {
  std::size_t count = 0;  ///< setpoints = count + 1
  double factor = 1;
};
/// Both in s; one cycle at least.
Cycles whole_cycles(double duration, double cycle_time);

}  // namespace bahnwerk
