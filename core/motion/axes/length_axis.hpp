#pragma once
/// An axis path with the arc length s as one more axis behind the others. Its limits are those of the tool along its
/// path, so code that treats axes only, such as the bound, includes them.
#include <cmath>

#include "core/machine/limits.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// The axis is q_n = s with q_n′ = 1. It costs no more than the underlying path, which has to outlive it and has less
/// than max_axes axes.
class LengthAxisPath final : public AxisPath {
 public:
  explicit LengthAxisPath(const AxisPath& path)
      : AxisPath(borrowed(path.tool()), path.axes() + 1, false), path_(path) {}

  bool linear(std::size_t segment) const override { return path_.linear(segment); }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  /// Returns the bounds of the path and, for the additional axis, those of a coordinate of the tool.
  MapBounds map_bounds(std::size_t segment, double u, double radius) const override;
  bool enclose(std::size_t segment, double u, double radius, AxisDiscs& axes) const override;
  double pose_turn(std::size_t segment, double u, double radius) const override {
    return path_.pose_turn(segment, u, radius);
  }

 private:
  std::size_t last() const { return axes() - 1; }

  const AxisPath& path_;
};

/// Returns the largest acceleration (mm/s²) along a path of `length` mm under limits along it, also where only jerk is
/// limited. A motion from rest to rest that never moves backwards and whose acceleration is continuous has a² ≤ 2 J v,
/// since reaching a, or reducing it to 0, takes that much of v. From v v′ = a ≤ √(2 J v) follows v³ ≤ 4.5 J s².
inline double largest_acceleration(const Limits& along, double length) {
  const double fastest = std::fmin(along.velocity, std::cbrt(4.5 * along.jerk * length * length));
  return std::fmin(along.acceleration, (1 + 1e-9) * std::sqrt(2 * along.jerk * fastest));
}

}  // namespace bahnwerk
