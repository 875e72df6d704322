#pragma once
/// A delta machine with three arms: motors theta1, theta2, theta3 (rad) turn arms that carry the tool by pairs of
/// parallel rods.
///
/// Arm k turns in the vertical plane at the angle α_k = 0°, 120°, 240° about the origin o, by θ_k downwards from the
/// horizontal. With the distance R of its axle from the middle (less that of the tool's joints from the tool's middle),
/// an arm of length a and rods of length L, and the tool at (X, Y, Z) in the plane's frame,
///
///   X = c (x − o_x) + s (y − o_y) − R,   Y = c (y − o_y) − s (x − o_x),   Z = z − o_z,   c = cos α_k, s = sin α_k,
///   (X − a cos θ)² + Y² + (Z + a sin θ)² = L²,   so   X cos θ − Z sin θ = w = (X² + Y² + Z² + a² − L²)/2a.
///
/// With p = √(X² + Z² − w²) the solution whose elbow is outside is θ = atan2(−Z, X) − atan2(p, w). Arm and rods in one
/// line, p = 0, are singular.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

struct RotaryDeltaSizes {
  Vec origin;                                      ///< place of the middle between the axles, at their height; mm
  double radius = 100;                             ///< R, mm
  double arm = 120, rod = 300;                     ///< a and L, mm
  double least_bend = 5 * std::numbers::pi / 180;  ///< rad; an arm closer to the line of its rods counts as singular
};

class RotaryDelta final : public FormulaKinematics<RotaryDelta> {
 public:
  /// `axes` are theta1, theta2, theta3.
  RotaryDelta(const RotaryDeltaSizes& sizes, std::vector<AxisLimits> axes)
      : FormulaKinematics(std::move(axes)), sizes_(sizes) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = 2 * std::numbers::pi / 3 * static_cast<double>(k);
      direction_[k] = {std::cos(angle), std::sin(angle), 0};
    }
  }

  template <class T>
  std::array<T, 3> solve(const NeedleOf<T>& tool) const {
    std::array<T, 3> q;
    const T x = tool.x - T(sizes_.origin.x), y = tool.y - T(sizes_.origin.y), z = tool.z - T(sizes_.origin.z);
    for (std::size_t k = 0; k < 3; ++k) {
      const double c = direction_[k].x, s = direction_[k].y, a = sizes_.arm;
      const T out = c * x + s * y - T(sizes_.radius), aside = c * y - s * x;
      const T square = out * out + z * z;
      const T w = (0.5 / a) * (square + aside * aside + T(a * a - sizes_.rod * sizes_.rod));
      q[k] = atan2(-z, out) - atan2(sqrt(square - w * w), w);
    }
    return q;
  }
  void check(const ToolPose& pose, const AxisArray& q) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec elbow = elbow_of(k, q[k]), rod = pose.position - elbow;
      const Vec arm = elbow - sizes_.origin - sizes_.radius * direction_[k];
      // The rods' part in the arm's plane: what is across it does not turn the motor.
      const Vec in_plane = rod - dot(rod, cross(direction_[k], Vec{0, 0, 1})) * cross(direction_[k], Vec{0, 0, 1});
      const double bend = angle_between(arm, in_plane);
      if (bend >= sizes_.least_bend && bend <= std::numbers::pi - sizes_.least_bend) continue;
      char text[240];
      std::snprintf(text, sizeof text,
                    "arm %zu and its rods would be in one line, out of reach or singular (least_bend)", k + 1);
      throw UnreachablePose(text, std::numeric_limits<double>::quiet_NaN(), pose.coordinates());
    }
  }
  /// Returns the lower intersection of the three spheres about the elbows, each moved inwards by the tool's size.
  ToolPose forward(const AxisArray& q) const override {
    const Vec a = elbow_of(0, q[0]), b = elbow_of(1, q[1]), c = elbow_of(2, q[2]);
    const Vec ex = (b - a) / norm(b - a);
    const double i = dot(ex, c - a), d = norm(b - a);
    const Vec across = c - a - i * ex, ey = across / norm(across), ez = cross(ex, ey);
    const double j = dot(ey, c - a), x = d / 2, y = (i * i + j * j) / (2 * j) - i / j * x;
    return {a + x * ex + y * ey - std::sqrt(sizes_.rod * sizes_.rod - x * x - y * y) * ez};
  }

 private:
  Vec elbow_of(std::size_t k, double angle) const {
    return sizes_.origin + (sizes_.radius + sizes_.arm * std::cos(angle)) * direction_[k] -
           Vec{0, 0, sizes_.arm * std::sin(angle)};
  }

  RotaryDeltaSizes sizes_;
  std::array<Vec, 3> direction_;
};

}  // namespace bahnwerk
