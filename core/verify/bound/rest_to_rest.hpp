#pragma once
/// The shortest straight move from rest to rest under limits on speed, acceleration and jerk, a lower bound of every
/// motion along a straight section.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/machine/machine.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk::verify {

/// Returns the duration over `way` mm, s; acceleration is finite, speed and jerk may be infinite. The move has jerk J,
/// 0, −J, 0, −J, 0, J without the phases that are not needed: full speed V is reached if way ≥ V (V/A + A/J), or V 2
/// √(V/J) when A is not; full acceleration A if way ≥ 2 A³/J².
inline double rest_to_rest(double way, double speed, double acceleration, double jerk) {
  if (!(way > 0)) return 0;
  const double ramp = acceleration / jerk;  // s, 0 without a limit on jerk
  const double change = speed >= acceleration * ramp ? speed / acceleration + ramp : 2 * std::sqrt(speed / jerk);
  if (way >= speed * change) return way / speed + change;
  if (way >= 2 * acceleration * ramp * ramp) return ramp + std::sqrt(ramp * ramp + 4 * way / acceleration);
  return std::cbrt(32 * way / jerk);
}

/// Returns the duration along a segment over which q is linear: all axes share one law.
inline double rest_to_rest(const AxisPath& path, std::size_t linear, double feed, const Machine& machine) {
  const double u = path[linear].curve().begin();
  const bool cartesian = path.cartesian();  // the path's own derivatives, without a conversion from eight axes
  const Vec way = cartesian ? path[linear].at_parameter(u).d1 : Vec{};
  const AxisArray other = cartesian ? AxisArray{} : path.at_parameter(linear, u).d1;
  Limits along;
  along.velocity = feed;
  for (std::size_t k = 0; k < path.axes(); ++k)
    if (const double rate = std::abs(cartesian ? way[k] : other[k]); rate > 1e-12)
      along.lower_to(machine.axes[k], rate);
  return rest_to_rest(path[linear].length(), along.velocity, along.acceleration, along.jerk);
}

}  // namespace bahnwerk::verify
