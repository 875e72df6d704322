#pragma once
/// The limits of one axis, or of the tool along its path: one bound per derivative.
#include <array>
#include <cstddef>
#include <limits>

namespace bahnwerk {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Largest magnitudes, in the axis' unit (mm for a linear axis, rad for a rotary one) and s; infinite: not limited.
struct Limits {
  double velocity = unlimited;                      ///< unit/s
  double acceleration = unlimited;                  ///< unit/s²
  double jerk = unlimited;                          ///< unit/s³
  double snap = unlimited;                          ///< unit/s⁴
  double lowest = -unlimited, highest = unlimited;  ///< range of positions, unit; has no meaning along a path

  static constexpr int highest_order = 4;
  /// Returns the bound of derivative 1 (velocity) to 4 (snap).
  double of(int order) const { return this->*derivatives()[static_cast<std::size_t>(order - 1)]; }
  double& of(int order) { return this->*derivatives()[static_cast<std::size_t>(order - 1)]; }
  bool has_range() const { return lowest > -unlimited || highest < unlimited; }

 private:
  static constexpr std::array<double Limits::*, highest_order> derivatives() {
    return {&Limits::velocity, &Limits::acceleration, &Limits::jerk, &Limits::snap};
  }
};

}  // namespace bahnwerk
