#pragma once
/// How the axes of a machine move its tool. Knows no path in time and no planner.
#include <array>
#include <cstddef>

#include "core/machine/axis_jet.hpp"
#include "core/machine/machine.hpp"
#include "core/machine/tool.hpp"

namespace bahnwerk {

/// How strongly axis positions can change with the tool's pose. Poses are points of the space (x, y, z, lever·φ,
/// lever·ψ), all in mm: for every pose that is asked for and every direction of unit length e, |∂ⁿ q_k/∂eⁿ| ≤ order[n −
/// 1][k], in the axis' unit per mmⁿ. Of mixed directions the same holds (a symmetric multilinear form is largest where
/// its arguments are equal: Banach, Studia Math. 7, 1938).
struct MapBounds {
  std::array<AxisArray, 4> order{};
};

class Kinematics {
 public:
  virtual ~Kinematics() = default;
  /// Names, units and ranges, in the axes' order; 1 to max_axes of them.
  virtual const std::vector<AxisLimits>& axes() const = 0;
  /// What one radian of the tool's angles counts as, mm; 0: the machine leaves them out of account.
  virtual double lever() const { return 0; }
  /// Positions of an axis that differ by so much are one place of the machine, and inverse() gives any of them. 0:
  /// none.
  virtual double period(std::size_t axis) const {
    (void)axis;
    return 0;
  }
  /// The axes while the tool moves: derivatives by the variable of `tool`. Throws UnreachablePose, with the pose and
  /// without a place, that of one out of reach and of one where axes are not smooth functions of the pose.
  virtual AxisJet inverse(const ToolJet& tool) const = 0;
  /// What inverse() gives for any tool within `tool`, and its analytic continuation for complex ones. False: not known,
  /// as where a singular pose cannot be excluded; bounds() may tell then.
  virtual bool enclose(const ToolDiscs& tool, AxisDiscs& axes) const {
    (void)tool, (void)axes;
    return false;
  }
  /// Where the tool is. Angles that do not count are 0, others hold to whole turns.
  virtual ToolPose forward(const AxisArray& axes) const = 0;
  /// For all poses within `radius` mm of `centre`: what makes enclosures of q(s) from those of the tool's path.
  virtual MapBounds bounds(const ToolPose& centre, double radius) const = 0;
  /// The same for complex poses and directions: wherever |pose − centre| ≤ radius (norm of a complex vector) inverse()
  /// is analytic and its derivatives of order 1 to 3 are no larger. Infinite where that is not known, or not so: for
  /// smaller discs it may be. With it the verifier's peaks are proven, without it they are estimates.
  virtual MapBounds complex_bounds(const ToolPose& centre, double radius) const {
    (void)centre, (void)radius;
    MapBounds unknown;
    for (AxisArray& order : unknown.order) order.fill(unlimited);
    return unknown;
  }
};

/// Axis k is coordinate k of the tool.
class Cartesian final : public Kinematics {
 public:
  explicit Cartesian(std::vector<AxisLimits> axes) : axes_(std::move(axes)) {}
  const std::vector<AxisLimits>& axes() const override { return axes_; }
  AxisJet inverse(const ToolJet& tool) const override {
    const Jet& p = tool.position;
    AxisJet q;
    for (std::size_t k = 0; k < axes_.size() && k < 3; ++k)
      q.value[k] = p.value[k], q.d1[k] = p.d1[k], q.d2[k] = p.d2[k], q.d3[k] = p.d3[k];
    return q;
  }
  ToolPose forward(const AxisArray& axes) const override { return {{axes[0], axes[1], axes[2]}}; }
  MapBounds bounds(const ToolPose&, double) const override {
    MapBounds b;
    for (std::size_t k = 0; k < axes_.size() && k < 3; ++k) b.order[0][k] = 1;
    return b;
  }
  MapBounds complex_bounds(const ToolPose& centre, double radius) const override { return bounds(centre, radius); }

 private:
  std::vector<AxisLimits> axes_;
};

}  // namespace bahnwerk
