#pragma once
/// A made-up machine with five axes: a smooth nonlinear map of the tool's position, so that limits of axes are nothing
/// like limits of the tool.
#include <cmath>

#include "core/machine/kinematics.hpp"
#include "core/numeric/taylor.hpp"

namespace bahnwerk::test {

/// Two arms' angles of a planar two-link arm whose base lies below the work, a carriage, a swivel that points along it,
/// and a leadscrew with a periodic error.
class FiveAxes : public Kinematics {
 public:
  static constexpr double arm = 150, base_x = 20, base_y = -180, error = 0.4, period = 40;  // mm
  FiveAxes() {
    axes_ = {{"shoulder", 3, 40, 3000},
             {"elbow", 4, 60, 4000},
             {"carriage", 900, 9000, 600000},
             {"swivel", 2.5, 30, 2500},
             {"screw", 1000, 12000, 800000}};
    for (const std::size_t k : {0u, 1u, 3u}) axes_[k].unit = "rad";
  }
  const std::vector<AxisLimits>& axes() const override { return axes_; }
  AxisJet inverse(const ToolJet& tool) const override {
    using T = Taylor<3>;
    const Jet& p = tool.position;
    const auto follow = [&](std::size_t k) { return T::from(p.value[k], p.d1[k], p.d2[k], p.d3[k]); };
    const T x = follow(0) - T(base_x), y = follow(1) - T(base_y), z = follow(2);
    const T square = x * x + y * y, bend = acos((square - T(2 * arm * arm)) * T(1 / (2 * arm * arm)));
    const T q[] = {atan2(y, x) - T(0.5) * bend, bend, T(0.6) * x + T(0.8) * y + z, atan2(z + T(60), T(80) + T(0.2) * x),
                   x + T(error) * sin(x * T(2 * 3.14159265358979323846 / period))};
    AxisJet jet;
    for (std::size_t k = 0; k < 5; ++k) {
      jet.value[k] = q[k].value();
      jet.d1[k] = q[k].derivative(1), jet.d2[k] = q[k].derivative(2), jet.d3[k] = q[k].derivative(3);
    }
    return jet;
  }
  ToolPose forward(const AxisArray& q) const override {
    const double reach = 2 * arm * std::cos(q[1] / 2), angle = q[0] + q[1] / 2;
    const double x = reach * std::cos(angle), y = reach * std::sin(angle);
    return {{base_x + x, base_y + y, q[2] - 0.6 * x - 0.8 * y}};
  }
  /// Generous, for tool positions within 100 mm of the middle of the work.
  MapBounds bounds(const ToolPose&, double) const override {
    MapBounds b;
    const double w = 2 * 3.14159265358979323846 / period;
    b.order[0] = {0.05, 0.05, 1.5, 0.05, 1 + error * w};
    b.order[1] = {2e-3, 2e-3, 0, 2e-3, error * w * w};
    b.order[2] = {2e-4, 2e-4, 0, 2e-4, error * w * w * w};
    b.order[3] = {4e-5, 4e-5, 0, 4e-5, error * w * w * w * w};
    return b;
  }
  /// Likewise generous; the screw's error grows with the distance from the real axis.
  MapBounds complex_bounds(const ToolPose& centre, double radius) const override {
    if (!(radius <= 15)) return Kinematics::complex_bounds(centre, radius);
    MapBounds b = bounds(centre, radius);
    for (AxisArray& order : b.order)
      for (double& most : order) most *= 2;
    const double w = 2 * 3.14159265358979323846 / period, grown = std::cosh(w * radius);
    b.order[0][4] = 1 + error * w * grown;
    b.order[1][4] = error * w * w * grown;
    b.order[2][4] = error * w * w * w * grown;
    return b;
  }

 private:
  std::vector<AxisLimits> axes_;
};

}  // namespace bahnwerk::test
