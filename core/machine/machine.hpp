#pragma once
/// The axes of a machine and what each may do. Cartesian: axis k is coordinate k of the tool head.
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace bahnwerk {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

struct AxisLimits {
  std::string name;
  double velocity = unlimited;      ///< mm/s
  double acceleration = unlimited;  ///< mm/s²
  double jerk = unlimited;          ///< mm/s³
};

/// Limits of speed, acceleration and jerk along the path: mm/s, mm/s², mm/s³.
struct AlongPath {
  double velocity = unlimited, acceleration = unlimited, jerk = unlimited;
};

struct Machine {
  std::vector<AxisLimits> axes;  ///< 2 or 3, in the order of the coordinates
  double cycle_time = 0.001;     ///< s
  std::size_t dimension() const { return axes.size(); }
};

}  // namespace bahnwerk
