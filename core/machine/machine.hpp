#pragma once
/// The axes of a machine and their limits.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/limits.hpp"

namespace bahnwerk {

/// An axis: its name, unit and limits.
struct AxisLimits : Limits {
  std::string name;
  std::string unit = "mm";  ///< mm or rad: the unit of positions, in which limits per s, s² … are given
  AxisLimits() = default;
  AxisLimits(std::string axis, const Limits& limits) : Limits(limits), name(std::move(axis)) {}
  AxisLimits(std::string axis, double fastest, double strongest = unlimited, double jerkiest = unlimited)
      : Limits{fastest, strongest, jerkiest}, name(std::move(axis)) {}
};

/// The axes of a machine and the cycle time of its controller.
struct Machine {
  std::vector<AxisLimits> axes;  ///< axis k here is axis k of the AxisPath; on a Cartesian machine, coordinate k
  double cycle_time = 0.001;     ///< s, time from one setpoint to the next
  std::size_t dimension() const { return axes.size(); }
};

}  // namespace bahnwerk
