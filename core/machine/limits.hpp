#pragma once
/// The limits of one axis, or of the tool along its path: one bound per derivative.
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace bahnwerk {

inline constexpr double unlimited = std::numeric_limits<double>::infinity();
/// Returns the name of a derivative of a position, orders 0 to 4.
constexpr const char* derivative_name(int order) {
  switch (order) {
    case 0:
      return "position";
    case 1:
      return "velocity";
    case 2:
      return "acceleration";
    case 3:
      return "jerk";
    default:
      return "snap";
  }
}

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
  /// Lowers the bounds of derivatives to those of a motion along which an axis with these limits moves by `rate` > 0 of
  /// its units per mm.
  void lower_to(const Limits& axis, double rate = 1) {
    for (int order = 1; order <= highest_order; ++order) of(order) = std::min(of(order), axis.of(order) / rate);
  }
  /// Multiplies the bounds of derivatives.
  void scale(double factor) {
    for (int order = 1; order <= highest_order; ++order) of(order) *= factor;
  }
  bool has_range() const { return lowest > -unlimited || highest < unlimited; }

 private:
  static constexpr std::array<double Limits::*, highest_order> derivatives() {
    return {&Limits::velocity, &Limits::acceleration, &Limits::jerk, &Limits::snap};
  }
};

}  // namespace bahnwerk
