#pragma once
/// Machines with equal axes.
#include <cstddef>
#include <string>

#include "core/machine/machine.hpp"

namespace bahnwerk::testing {

/// Axes x, y, z, or the first `count` of them, with the limits of one.
inline Machine equal_axes(std::size_t count, double velocity, double acceleration, double jerk = unlimited) {
  Machine machine;
  for (std::size_t k = 0; k < count; ++k)
    machine.axes.push_back({std::string(1, "xyz"[k]), velocity, acceleration, jerk});
  return machine;
}

/// The machine of the motion tests and their benchmark: two equal axes of a fast laser cutter.
inline Machine two_axes() { return equal_axes(2, 1800, 16000); }

}  // namespace bahnwerk::testing
