#pragma once
/// An axis path with one more axis behind the others: the arc length s itself. Its limits are those of the tool along
/// its path, so whoever looks at axes alone, as the bound does, knows them too.
#include <cmath>

#include "core/machine/limits.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// q_n = s, q_n′ = 1. Costs no more than the path that it stands on, which outlives it and has less than max_axes axes.
class LengthAxisPath final : public AxisPath {
 public:
  explicit LengthAxisPath(const AxisPath& path)
      : AxisPath(borrowed(path.tool()), path.axes() + 1, false), path_(path) {}

  bool linear(std::size_t segment) const override { return path_.linear(segment); }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  /// As if of a coordinate of the tool that happens to be s: no direction changes it faster.
  MapBounds map_bounds(std::size_t segment, double u, double radius) const override;
  bool enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const override;
  double pose_turn(std::size_t segment, double u, double radius) const override {
    return path_.pose_turn(segment, u, radius);
  }

 private:
  std::size_t last() const { return axes() - 1; }

  const AxisPath& path_;
};

/// The largest acceleration (mm/s²) along a path of `length` mm that limits along it allow, also where only jerk is
/// limited. A motion from rest to rest that never turns back and whose acceleration is continuous has a² ≤ 2 J v: to
/// come to a, or to be rid of it, it takes that much of v. From v v′ = a ≤ √(2 J v) follows v³ ≤ 4.5 J s².
inline double largest_acceleration(const Limits& along, double length) {
  const double fastest = std::fmin(along.velocity, std::cbrt(4.5 * along.jerk * length * length));
  return std::fmin(along.acceleration, (1 + 1e-9) * std::sqrt(2 * along.jerk * fastest));
}

}  // namespace bahnwerk
