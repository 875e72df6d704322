#include "core/machine/tool_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bahnwerk {

ToolLimits tool_limits(const Machine& cartesian) {
  ToolLimits t{0, unlimited, unlimited, 0};
  double square = 0, pull = 0;
  for (const AxisLimits& axis : cartesian.axes) {
    pull += axis.acceleration * axis.acceleration;
    square += axis.velocity * axis.velocity;
    t.acceleration = std::min(t.acceleration, axis.acceleration);
    t.jerk = std::min(t.jerk, axis.jerk);
  }
  t.speed = std::sqrt(square), t.pull = std::sqrt(pull);
  return t;
}

ToolLimits tool_limits(const Kinematics& kinematics, const Machine& limits, std::size_t coordinates, Vec position) {
  const std::size_t axes = limits.dimension();
  std::array<Vec, max_axes> rows{};  // of J
  for (std::size_t i = 0; i < coordinates; ++i) {
    ToolJet tool{};
    tool.position.value = position;
    tool.position.d1[i] = 1;
    const AxisJet q = kinematics.inverse(tool);
    for (std::size_t k = 0; k < axes; ++k) rows[k][i] = q.d1[k];
  }
  Vec n[3];  // JᵀJ, and the unit for coordinates that do not move
  for (std::size_t k = 0; k < axes; ++k)
    for (std::size_t i = 0; i < coordinates; ++i) n[i] += rows[k][i] * rows[k];
  for (std::size_t i = coordinates; i < 3; ++i) n[i][i] = 1;
  const double volume = dot(n[0], cross(n[1], n[2]));
  ToolLimits t{0, unlimited, unlimited, 0};
  Vec speed, pull;
  const auto add = [](double part, double limit) { return part == 0 ? 0 : part * limit; };
  for (std::size_t k = 0; k < axes; ++k) {
    const double row = norm(rows[k]);
    if (row == 0) continue;
    t.acceleration = std::min(t.acceleration, limits.axes[k].acceleration / row);
    t.jerk = std::min(t.jerk, limits.axes[k].jerk / row);
    const Vec back = (rows[k].x * cross(n[1], n[2]) + rows[k].y * cross(n[2], n[0]) + rows[k].z * cross(n[0], n[1])) /
                     volume;  // column k of J⁺
    for (std::size_t i = 0; i < coordinates; ++i) {
      speed[i] += add(std::abs(back[i]), limits.axes[k].velocity);
      pull[i] += add(std::abs(back[i]), limits.axes[k].acceleration);
    }
  }
  t.speed = norm(speed), t.pull = norm(pull);
  return t;
}

}  // namespace bahnwerk
