#pragma once
/// The axes of a machine and their limits.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/limits.hpp"

namespace bahnwerk {

struct AxisLimits : Limits {
  std::string name;
  std::string unit = "mm";
  AxisLimits() = default;
  AxisLimits(std::string axis, const Limits& limits) : Limits(limits), name(std::move(axis)) {}
  AxisLimits(std::string axis, double fastest, double strongest = unlimited, double jerkiest = unlimited)
      : Limits{fastest, strongest, jerkiest}, name(std::move(axis)) {}
};

struct Machine {
  std::vector<AxisLimits> axes;  ///< in the order of an AxisPath's axes; Cartesian: axis k is coordinate k
  double cycle_time = 0.001;     ///< s
  std::size_t dimension() const { return axes.size(); }
};

}  // namespace bahnwerk
