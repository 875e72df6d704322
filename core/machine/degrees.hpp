#pragma once
/// Rotary axes in deg, as documents and setpoints show them; core has rad.
#include <numbers>

#include "core/machine/machine.hpp"

namespace bahnwerk {

/// Returns the machine with its rotary axes in deg: units, limits and ranges.
inline Machine in_degrees(Machine machine) {
  constexpr double degrees = 180 / std::numbers::pi;
  for (AxisLimits& axis : machine.axes) {
    if (axis.unit != "rad") continue;
    axis.unit = "deg";
    for (int order = 1; order <= Limits::highest_order; ++order) axis.of(order) *= degrees;
    axis.lowest *= degrees, axis.highest *= degrees;
  }
  return machine;
}

}  // namespace bahnwerk
