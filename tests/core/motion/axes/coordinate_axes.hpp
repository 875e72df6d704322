#pragma once
/// A machine whose axes are coordinates of the tool, each in a unit of its own; those from the third on repeat the
/// first two. Units and repeated axes change nothing: what holds for x and y holds for it.
#include <cmath>
#include <string>

#include "core/machine/kinematics.hpp"

namespace bahnwerk::test {

class CoordinateAxes final : public Kinematics {
 public:
  /// `x` and `y` in mm; the units of four axes after each other lie `decades` powers of ten apart, the third one is mm.
  CoordinateAxes(std::size_t count, const Limits& x, const Limits& y, int decades) : decades_(decades) {
    for (std::size_t k = 0; k < count; ++k) {
      const Limits& limit = k % 2 == 0 ? x : y;
      axes_.emplace_back("a" + std::to_string(k), limit.velocity * unit(k), limit.acceleration * unit(k),
                         limit.jerk * unit(k));
    }
  }
  double unit(std::size_t k) const { return std::pow(10.0, decades_ * (static_cast<double>(k % 4) - 2)); }
  const std::vector<AxisLimits>& axes() const override { return axes_; }
  AxisJet inverse(const ToolJet& tool) const override {
    const Jet& p = tool.position;
    AxisJet q;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      q.value[k] = unit(k) * p.value[k % 2], q.d1[k] = unit(k) * p.d1[k % 2];
      q.d2[k] = unit(k) * p.d2[k % 2], q.d3[k] = unit(k) * p.d3[k % 2];
    }
    return q;
  }
  ToolPose forward(const AxisArray& q) const override { return {{q[0] / unit(0), q[1] / unit(1), 0}}; }
  MapBounds bounds(const ToolPose&, double) const override {
    MapBounds b;
    for (std::size_t k = 0; k < axes_.size(); ++k) b.order[0][k] = unit(k);
    return b;
  }

 private:
  int decades_;
  std::vector<AxisLimits> axes_;
};

}  // namespace bahnwerk::test
