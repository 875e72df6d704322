#pragma once
/// A delta machine with three columns: carriages A, B, C (mm, upwards) carry the tool by pairs of parallel rods.
///
/// With the centre at the origin o, column k at the angle α_k = 210°, 330°, 90° and the distance R (what the joints on
/// carriage and tool take off is not counted), and rods of length L, the tool is at the height h below its carriage:
///
///   q_k = z − o_z + √(L² − (x − o_x − R cos α_k)² − (y − o_y − R sin α_k)²).
///
/// A rod that lies flat is singular: its carriage cannot move the tool sideways any more.
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

#include "core/machine/formula_kinematics.hpp"

namespace bahnwerk {

struct LinearDeltaSizes {
  Vec origin;                                        ///< place of the middle between the columns; its height; mm
  double radius = 150;                               ///< R, mm
  double rod = 300;                                  ///< L, mm
  double least_angle = 10 * std::numbers::pi / 180;  ///< rad; rods that lie flatter count as singular
};

class LinearDelta final : public FormulaKinematics<LinearDelta> {
 public:
  /// `axes` are A, B, C.
  LinearDelta(const LinearDeltaSizes& sizes, std::vector<AxisLimits> axes)
      : FormulaKinematics(std::move(axes)), sizes_(sizes) {
    constexpr double degree = std::numbers::pi / 180;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = std::array{210.0, 330.0, 90.0}[k] * degree;
      columns_[k] = sizes.origin + sizes.radius * Vec{std::cos(angle), std::sin(angle), 0};
    }
  }

  template <class T>
  std::array<T, 3> solve(const NeedleOf<T>& tool) const {
    std::array<T, 3> q;
    for (std::size_t k = 0; k < 3; ++k) {
      const T x = tool.x - T(columns_[k].x), y = tool.y - T(columns_[k].y);
      q[k] = tool.z - T(sizes_.origin.z) + sqrt(T(sizes_.rod * sizes_.rod) - x * x - y * y);
    }
    return q;
  }
  void check(const ToolPose& pose, const AxisArray&) const {
    const double most = sizes_.rod * std::cos(sizes_.least_angle);
    for (std::size_t k = 0; k < 3; ++k) {
      const double away = std::hypot(pose.position.x - columns_[k].x, pose.position.y - columns_[k].y);
      if (away <= most) continue;
      char text[240];
      std::snprintf(text, sizeof text,
                    "the tool would be %.6g mm from column %c, the rods move it freely up to %.6g mm", away, "ABC"[k],
                    most);
      throw UnreachablePose(text, std::numeric_limits<double>::quiet_NaN(), pose.coordinates());
    }
  }
  /// Returns the lower intersection of the three spheres about the carriages (trilateration).
  ToolPose forward(const AxisArray& q) const override {
    std::array<Vec, 3> c = columns_;
    for (std::size_t k = 0; k < 3; ++k) c[k].z = sizes_.origin.z + q[k];
    const Vec ex = (c[1] - c[0]) / norm(c[1] - c[0]);
    const double i = dot(ex, c[2] - c[0]), d = norm(c[1] - c[0]);
    const Vec across = c[2] - c[0] - i * ex, ey = across / norm(across), ez = cross(ex, ey);
    const double j = dot(ey, c[2] - c[0]), x = d / 2, y = (i * i + j * j) / (2 * j) - i / j * x;
    return {c[0] + x * ex + y * ey - std::sqrt(sizes_.rod * sizes_.rod - x * x - y * y) * ez};
  }

 private:
  LinearDeltaSizes sizes_;
  std::array<Vec, 3> columns_;
};

}  // namespace bahnwerk
