#pragma once
/// Two arms in the plane: axes theta1 at the shoulder, theta2 at the elbow (rad) and, where there is one, z (mm).
///
/// With the shoulder at the origin o,
///
///   x − o_x = l1 cos θ1 + l2 cos(θ1 + θ2),   y − o_y = l1 sin θ1 + l2 sin(θ1 + θ2).
///
/// With w the square of the tool's distance from the shoulder, p = √(((l1 + l2)² − w)(w − (l1 − l2)²)) and σ = 1 for an
/// elbow to the right (θ2 > 0), −1 for one to the left,
///
///   θ2 = σ atan2(p, w − l1² − l2²),   θ1 = atan2(y − o_y, x − o_x) − β,   β = σ atan2(p, w + l1² − l2²),
///
/// and, as p p′ = (l1² + l2² − w) w′, θ2′ = −σ w′/p, β′ = −σ (1 + (l2² − l1²)/w) w′/2p, and β = θ2/2 for equal arms.
///
/// Stretched or folded arms (θ2 = 0° or 180°) are singular: the tool cannot move along them.
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

struct ScaraSizes {
  Vec origin;                                      ///< place of the shoulder; height at which z = 0; mm
  double l1 = 200, l2 = 200;                       ///< upper and lower arm, mm
  double least_bend = 1 * std::numbers::pi / 180;  ///< rad; arms straighter or as far folded count as singular
  bool right = true;                               ///< whether θ2 > 0
};

class ScaraMachine final : public FormulaKinematics<ScaraMachine> {
 public:
  /// `axes` are theta1, theta2 and possibly z.
  ScaraMachine(const ScaraSizes& sizes, std::vector<AxisLimits> axes)
      : FormulaKinematics(std::move(axes)), sizes_(sizes) {}

  template <class T>
  std::array<T, 3> solve(const NeedleOf<T>& tool) const {
    const double l1 = sizes_.l1, l2 = sizes_.l2, sign = sizes_.right ? 1 : -1;
    const double square1 = l1 * l1, square2 = l2 * l2;
    const T x = tool.x - T(sizes_.origin.x), y = tool.y - T(sizes_.origin.y);
    const T w = x * x + y * y, p = sqrt((T((l1 + l2) * (l1 + l2)) - w) * (w - T((l1 - l2) * (l1 - l2))));
    const T half = (0.5 * sign) * (derived(w) / p);
    const T bend = atan2(sign * p, w - T(square1 + square2), -2.0 * half);
    const T beta =
        l1 == l2 ? 0.5 * bend : atan2(sign * p, w - T(square2 - square1), -(half + (square2 - square1) * half / w));
    return {atan2(y, x, (derived(y) * x - derived(x) * y) / w) - beta, bend, tool.z - T(sizes_.origin.z)};
  }
  void check(const ToolPose& pose, const AxisArray& q) const {
    const double bend = std::abs(q[1]);
    if (bend >= sizes_.least_bend && bend <= std::numbers::pi - sizes_.least_bend) return;
    const double l1 = sizes_.l1, l2 = sizes_.l2,
                 r = std::hypot(pose.position.x - sizes_.origin.x, pose.position.y - sizes_.origin.y);
    const auto reach = [&](double angle) { return std::sqrt(l1 * l1 + l2 * l2 + 2 * l1 * l2 * std::cos(angle)); };
    char text[240];
    std::snprintf(text, sizeof text,
                  "the tool would be %.6g mm from the shoulder, the arms move freely from %.6g to %.6g mm", r,
                  reach(std::numbers::pi - sizes_.least_bend), reach(sizes_.least_bend));
    throw UnreachablePose(text, std::numeric_limits<double>::quiet_NaN(), pose.coordinates());
  }
  ToolPose forward(const AxisArray& q) const override {
    const double l1 = sizes_.l1, l2 = sizes_.l2, both = q[0] + q[1];
    return {{sizes_.origin.x + l1 * std::cos(q[0]) + l2 * std::cos(both),
             sizes_.origin.y + l1 * std::sin(q[0]) + l2 * std::sin(both),
             axes().size() > 2 ? sizes_.origin.z + q[2] : 0}};
  }

 private:
  ScaraSizes sizes_;
};

}  // namespace bahnwerk
