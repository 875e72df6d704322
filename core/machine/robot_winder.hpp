#pragma once
/// A SCARA robot with a swivel at the lower end of its quill [Herrmann 2.3.3, 3.1.2, 3.1.3].
///
/// Axes: q1 shoulder, q2 elbow, rad; q3 height of the swivel, mm; q4 turns the quill, q5 swivels the needle, rad. The
/// machine's frame has its z axis along the shoulder's, upwards. With θ = q1 + q2 + q4, the distance o of the swivel's
/// axis from the quill's and the distance l of the needle's tip from the swivel's axis [Herrmann (3.7), corrected]:
///
///   x = l1 cos q1 + l2 cos(q1 + q2) + (o + l cos q5) cos θ
///   y = l1 sin q1 + l2 sin(q1 + q2) + (o + l cos q5) sin θ
///   z = q3 − l sin q5,   φ = θ,   ψ = q5.
#include <cmath>
#include <cstdio>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

/// The elbow's configuration: righty has q2 > 0 [Herrmann (3.18)].
enum class RobotArm { lefty, righty };

/// Sizes, mm. The source gives no values (it shows them in a figure); the defaults are assumed for a reach of 800 mm,
/// that of the robot named there.
struct RobotWinderSizes {
  double l1 = 400, l2 = 400;  ///< upper arm l_1, lower arm l_2
  double o_tool = 20;         ///< o_Tool: distance from the quill's axis to the swivel's
  double l_tool = 50;         ///< l_Tool: distance from the swivel's axis to the needle's tip
  double least_bend = 0.01;   ///< rad; an elbow angle closer to 0° or 180° is singular
  PartPlace part{{450, 0, 0}, 0};
};

class RobotWinder final : public FormulaKinematics<RobotWinder> {
 public:
  static constexpr std::size_t swivel = 4;
  /// `limits` are those of q1 … q5, angles in rad. Throws std::invalid_argument for another count.
  RobotWinder(const RobotWinderSizes& sizes, RobotArm arm, const std::vector<Limits>& limits)
      : FormulaKinematics(numbered_axes<5>(limits, {true, true, false, true, true})), sizes_(sizes), arm_(arm) {}

  /// Returns the axes [Herrmann (3.13)–(3.19)], the sign of (3.19) corrected. With the quill at (x, y) from the
  /// shoulder, w = x² + y², p = √(((l1 + l2)² − w)(w − (l1 − l2)²)) and σ = 1 for righty, −1 for lefty
  ///
  ///   q2 = σ atan2(p, w − l1² − l2²),   q1 = atan2(y, x) − β,   β = σ atan2(p, w + l1² − l2²),
  ///
  /// where p = 2 l1 l2 |sin q2| = 2 l1 · (the quill's distance from the upper arm's line). With
  /// p p′ = (l1² + l2² − w) w′ the derivatives are
  ///
  ///   q2′ = −σ w′/p,   β′ = −σ (1 + (l2² − l1²)/w) w′/2p,
  ///
  /// and β = q2/2 for arms of equal lengths.
  template <class T>
  std::array<T, 5> solve(const NeedleOf<T>& part) const {
    const NeedleOf<T> n = sizes_.part.placed(part);
    const double l1 = sizes_.l1, l2 = sizes_.l2, square1 = l1 * l1, square2 = l2 * l2,
                 sign = arm_ == RobotArm::righty ? 1 : -1;
    const auto [swivel_s, swivel_c] = sine_cosine(n.psi);
    const auto [azimuth_s, azimuth_c] = sine_cosine(n.phi);
    const T reach = T(sizes_.o_tool) + sizes_.l_tool * swivel_c;
    const T x = n.x - azimuth_c * reach, y = n.y - azimuth_s * reach;  // (3.16)
    const T w = x * x + y * y, p = sqrt((T((l1 + l2) * (l1 + l2)) - w) * (w - T((l1 - l2) * (l1 - l2))));
    const T half = (0.5 * sign) * (derived(w) / p);
    const T q2 = atan2(sign * p, w - T(square1 + square2), -2.0 * half);
    const T beta =
        l1 == l2 ? 0.5 * q2 : atan2(sign * p, w - T(square2 - square1), -(half + (square2 - square1) * half / w));
    const T q1 = atan2(y, x, (derived(y) * x - derived(x) * y) / w) - beta;
    return {q1, q2, n.z + sizes_.l_tool * swivel_s, n.phi - q1 - q2, n.psi};
  }
  /// Throws where the elbow is too straight or too far folded.
  void check(const ToolPose& pose, const AxisArray& q) const {
    const double bend = std::abs(q[1]);
    if (bend >= sizes_.least_bend && bend <= std::numbers::pi - sizes_.least_bend) return;
    const NeedleOf<double> n =
        sizes_.part.placed(NeedleOf<double>{pose.position.x, pose.position.y, pose.position.z, pose.phi, pose.psi});
    const double reach = sizes_.o_tool + sizes_.l_tool * std::cos(n.psi), l1 = sizes_.l1, l2 = sizes_.l2,
                 r = std::hypot(n.x - std::cos(n.phi) * reach, n.y - std::sin(n.phi) * reach);
    char text[200];
    std::snprintf(
        text, sizeof text, "the quill would be %.6g mm from the shoulder, the arm reaches from %.6g to %.6g mm%s", r,
        std::abs(l1 - l2), l1 + l2,
        r <= l1 + l2 && r >= std::abs(l1 - l2) ? " and cannot move freely next to the ends of that (a singular pose)"
                                               : "");
    throw UnreachablePose(text, std::numeric_limits<double>::quiet_NaN(), pose.coordinates());
  }
  ToolPose forward(const AxisArray& q) const override {
    const double turned = q[0] + q[1], phi = turned + q[3], reach = sizes_.o_tool + sizes_.l_tool * std::cos(q[4]);
    return sizes_.part.taken_back({{sizes_.l1 * std::cos(q[0]) + sizes_.l2 * std::cos(turned) + reach * std::cos(phi),
                                    sizes_.l1 * std::sin(q[0]) + sizes_.l2 * std::sin(turned) + reach * std::sin(phi),
                                    q[2] - sizes_.l_tool * std::sin(q[4])},
                                   phi,
                                   q[4]});
  }
  RobotArm arm() const { return arm_; }

 private:
  RobotWinderSizes sizes_;
  RobotArm arm_;
};

}  // namespace bahnwerk
