#pragma once
/// A rotary table under a tool that moves along a radius: axes theta (rad), r and, where there is one, z (mm).
///
/// The table turns the part by θ about the centre c, counter-clockwise; the tool is at the distance r from it, in the
/// fixed direction of the machine's x axis. So the point of the part at the angle φ is under the tool at θ = −φ:
///
///   x − c_x = r cos θ,   y − c_y = −r sin θ,   r = √((x − c_x)² + (y − c_y)²),   θ = −atan2(y − c_y, x − c_x).
///
/// At the centre θ has no value, and next to it θ′ grows like 1/r: the machine is singular there.
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

struct PolarSizes {
  Vec origin;               ///< place of the table's axis in the contour's coordinates; height at which z = 0; mm
  double least_radius = 1;  ///< mm; places closer to the table's axis count as singular
};

class PolarMachine final : public FormulaKinematics<PolarMachine> {
 public:
  /// `axes` are theta, r and possibly z.
  PolarMachine(const PolarSizes& sizes, std::vector<AxisLimits> axes)
      : FormulaKinematics(std::move(axes)), sizes_(sizes) {}

  template <class T>
  std::array<T, 3> solve(const NeedleOf<T>& tool) const {
    const T x = tool.x - T(sizes_.origin.x), y = tool.y - T(sizes_.origin.y);
    const T w = x * x + y * y;
    return {-atan2(y, x, (derived(y) * x - derived(x) * y) / w), sqrt(w), tool.z - T(sizes_.origin.z)};
  }
  void check(const ToolPose& pose, const AxisArray& q) const {
    if (q[1] >= sizes_.least_radius) return;
    char text[240];
    std::snprintf(text, sizeof text,
                  "the tool would be %.4g mm from the table's axis, where theta has no definite value (least_radius: "
                  "%.4g mm)",
                  std::isnan(q[1]) ? 0 : q[1], sizes_.least_radius);
    throw UnreachablePose(text, std::numeric_limits<double>::quiet_NaN(), pose.coordinates());
  }
  ToolPose forward(const AxisArray& q) const override {
    return {{sizes_.origin.x + q[1] * std::cos(q[0]), sizes_.origin.y - q[1] * std::sin(q[0]),
             axes().size() > 2 ? sizes_.origin.z + q[2] : 0}};
  }

 private:
  PolarSizes sizes_;
};

}  // namespace bahnwerk
