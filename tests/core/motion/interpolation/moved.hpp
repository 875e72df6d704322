#pragma once
/// Motions along paths for the tests of the interpolators.
#include <cmath>
#include <memory>
#include <utility>

#include "core/geometry/curve/rational.hpp"
#include "core/motion/law/path_motion.hpp"

namespace bahnwerk::test {

struct Moved {
  std::shared_ptr<const Path> path;
  std::shared_ptr<const PathMotion> motion;
  std::size_t cycles = 0;
  double cycle_time = 0;
};

/// Along a path with the law `ds` of its first segment alone, or at constant speed; lasts `cycles` cycles.
inline std::shared_ptr<const PathMotion> motion_of(const std::shared_ptr<const Path>& path, TimeLaw law) {
  struct SharedAxisPath {
    std::shared_ptr<const Path> path;
    CartesianAxisPath axes;
    explicit SharedAxisPath(std::shared_ptr<const Path> p) : path(std::move(p)), axes(*path, 3) {}
  };
  auto kept = std::make_shared<const SharedAxisPath>(path);
  return std::make_shared<const PathMotion>(std::shared_ptr<const AxisPath>(kept, &kept->axes), std::move(law));
}

inline Moved at_constant_speed(std::shared_ptr<const Path> path, std::size_t cycles, double cycle_time) {
  const double speed = path->length() / (static_cast<double>(cycles) * cycle_time);
  TimeLaw law;
  for (std::size_t i = 0; i < path->size(); ++i) {
    const Segment& segment = (*path)[i];
    law.append({0, segment.length() / speed, segment.s0(), segment.s1(), speed, 0, 0, i, 0});
  }
  auto motion = motion_of(path, std::move(law));
  return {std::move(path), std::move(motion), cycles, cycle_time};
}

/// From rest to rest along a path of one segment: three pieces of jerk in each half, the speed a cubic spline.
inline Moved from_rest_to_rest(std::shared_ptr<const Path> path, std::size_t cycles, double cycle_time) {
  const double length = path->length(), duration = static_cast<double>(cycles) * cycle_time, half = duration / 2,
               quarter = duration / 4;
  // s = j τ³/6 for a quarter, then the same backwards: half of the way is j (T/4)³.
  const double j = length / (2 * quarter * quarter * quarter), v = j * quarter * quarter / 2;
  TimeLaw law;
  law.append({0, quarter, 0, length / 12, 0, 0, j, 0, 0});
  law.append({0, half, length / 12, length * 11 / 12, v, j * quarter, -j, 0, 0});
  law.append({0, quarter, length * 11 / 12, length, v, -j * quarter, j, 0, 0});
  auto motion = motion_of(path, std::move(law));
  return {std::move(path), std::move(motion), cycles, cycle_time};
}

inline std::shared_ptr<const Path> path_of(std::initializer_list<std::shared_ptr<const Curve>> curves) {
  Path path;
  for (const auto& curve : curves) path.append(curve, path.size());
  return std::make_shared<const Path>(std::move(path));
}

/// A quarter of an ellipse as a rational quadratic; radii equal: of a circle. Its parameter runs unevenly.
inline std::shared_ptr<const Curve> quarter_ellipse(double a, double b) {
  return std::make_shared<const Rational>(Rational::bezier({{a, 0, 0}, {a, b, 0}, {0, b, 0}}, {1, std::sqrt(0.5), 1}));
}

/// A rational quintic in space.
inline std::shared_ptr<const Curve> quintic() {
  return std::make_shared<const Rational>(Rational::bezier(
      {{0, 0, 0}, {8, 1, 2}, {15, 9, 6}, {20, 14, 4}, {24, 25, -3}, {40, 26, -2}}, {1, 1.2, 0.8, 1.5, 1, 0.9}));
}

}  // namespace bahnwerk::test
