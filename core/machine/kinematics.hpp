#pragma once
/// How the axes of a machine move its tool. Knows no path in time and no planner.
#include <array>
#include <cstddef>

#include "core/geometry/curve/curve.hpp"
#include "core/machine/axis_jet.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

/// How strongly axis positions can change with the tool's position: for every tool position that is asked for and every
/// direction of unit length e, |∂ⁿ q_k/∂eⁿ| ≤ order[n − 1][k], in the axis' unit per mmⁿ. Of mixed directions the same
/// holds (a symmetric multilinear form is largest where its arguments are equal: Banach, Studia Math. 7, 1938).
struct MapBounds {
  std::array<AxisArray, 4> order{};
};

class Kinematics {
 public:
  virtual ~Kinematics() = default;
  /// Names, units and ranges, in the axes' order; 1 to max_axes of them.
  virtual const std::vector<AxisLimits>& axes() const = 0;
  /// The axes while the tool moves: derivatives by the variable of `tool`. Throws UnreachablePose.
  virtual AxisJet inverse(const Jet& tool) const = 0;
  /// Where the tool is.
  virtual Vec forward(const AxisArray& axes) const = 0;
  /// For all tool positions within `radius` mm of `centre`: what makes enclosures of q(s) from those of the tool's
  /// path.
  virtual MapBounds bounds(const Vec& centre, double radius) const = 0;
  /// The same for complex tool positions and directions: wherever |position − centre| ≤ radius (norm of a complex
  /// vector) inverse() is analytic and its derivatives of order 1 to 3 are no larger. Infinite where that is not known,
  /// or not so: for smaller discs it may be. With it the verifier's peaks are proven, without it they are estimates.
  virtual MapBounds complex_bounds(const Vec& centre, double radius) const {
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
  AxisJet inverse(const Jet& tool) const override {
    AxisJet q;
    for (std::size_t k = 0; k < axes_.size() && k < 3; ++k)
      q.value[k] = tool.value[k], q.d1[k] = tool.d1[k], q.d2[k] = tool.d2[k], q.d3[k] = tool.d3[k];
    return q;
  }
  Vec forward(const AxisArray& axes) const override { return {axes[0], axes[1], axes[2]}; }
  MapBounds bounds(const Vec&, double) const override {
    MapBounds b;
    for (std::size_t k = 0; k < axes_.size() && k < 3; ++k) b.order[0][k] = 1;
    return b;
  }
  MapBounds complex_bounds(const Vec& centre, double radius) const override { return bounds(centre, radius); }

 private:
  std::vector<AxisLimits> axes_;
};

}  // namespace bahnwerk
