#pragma once
/// The map between the axes of a machine and its tool. It is independent of paths, time and planners.
#include <array>
#include <cstddef>

#include "core/machine/axis_jet.hpp"
#include "core/machine/machine.hpp"
#include "core/machine/tool.hpp"

namespace bahnwerk {

/// Bounds on the derivatives of axis positions by the tool's pose. Poses are points of the space (x, y, z, lever·φ,
/// lever·ψ), all in mm. For every pose in question and every direction of unit length e, |∂ⁿ q_k/∂eⁿ| ≤ order[n −
/// 1][k], in the axis' unit per mmⁿ. The bound holds for mixed directions, too (a symmetric multilinear form is largest
/// where its arguments are equal: Banach, Studia Math. 7, 1938).
struct MapBounds {
  std::array<AxisArray, 4> order{};
};

/// Axis k of a linear machine is rows[k] · p for the tool's position p, mm.
struct LinearMap {
  std::array<Vec, max_axes> rows{};
};

/// Immutable and thread-safe.
class Kinematics {
 public:
  virtual ~Kinematics() = default;
  /// Returns name, unit and limits of each axis; there are 1 to max_axes axes.
  virtual const std::vector<AxisLimits>& axes() const = 0;
  /// Returns the length that one radian of the tool's angles counts as, mm; 0: the machine ignores the angles.
  virtual double lever() const { return 0; }
  /// Returns the map if all axes are linear in the tool's position; null: they are not.
  virtual const LinearMap* linear() const { return nullptr; }
  /// Returns the period of an axis: positions that differ by it are one place of the machine, and inverse() returns any
  /// of them. 0: none.
  virtual double period(std::size_t axis) const {
    (void)axis;
    return 0;
  }
  /// Returns the axes of a moving tool; derivatives are by the variable of `tool`. Throws UnreachablePose, with the
  /// pose and without a place, for a pose out of reach and for one at which axes are not smooth functions of the pose.
  virtual AxisJet inverse(const ToolJet& tool) const = 0;
  /// Encloses inverse() for any tool within `tool`, and its analytic continuation for complex ones. Returns false if no
  /// enclosure is known, as where a singular pose cannot be excluded; bounds() may give one.
  virtual bool enclose(const ToolDiscs& tool, AxisDiscs& axes) const {
    (void)tool, (void)axes;
    return false;
  }
  /// Returns the pose of the tool. Angles that do not count are 0, others are determined up to whole turns.
  virtual ToolPose forward(const AxisArray& axes) const = 0;
  /// Returns bounds for all poses within `radius` mm of `centre`; with them enclosures of the tool's path give those of
  /// q(s).
  virtual MapBounds bounds(const ToolPose& centre, double radius) const = 0;
  /// Returns bounds for complex poses and directions: wherever |pose − centre| ≤ radius (norm of a complex vector)
  /// inverse() is analytic and its derivatives of order 1 to 3 are no larger. Entries are infinite where no bound is
  /// known; smaller balls may have bounds. They make the verifier's peaks proofs instead of estimates.
  virtual MapBounds complex_bounds(const ToolPose& centre, double radius) const {
    (void)centre, (void)radius;
    MapBounds unknown;
    for (AxisArray& order : unknown.order) order.fill(unlimited);
    return unknown;
  }
};

/// The Cartesian machine: axis k is coordinate k of the tool.
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
