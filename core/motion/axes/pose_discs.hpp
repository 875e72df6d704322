#pragma once
/// Where a tool can be, and how it can move, all along a stretch of its path: enclosures.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/geometry/path/path.hpp"
#include "core/machine/tool.hpp"
#include "core/motion/axes/orientation.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// Immutable and thread-safe.
class PoseDiscs {
 public:
  /// Reads `tool`, keeps `orientation`, which may be empty: then the angles are 0.
  PoseDiscs(const Path& tool, std::shared_ptr<const Orientation> orientation);

  /// Pose with derivatives by arc length, for all complex parameters within `radius` of u, on the segment's curve and
  /// its continuation. False: not known, as where the parametric tangent may vanish. O(degree²), 1 to 2 µs.
  bool enclose(const Segment& segment, std::size_t index, double u, double radius, ToolDiscs& tool) const;

 private:
  /// origin + N(t)/w(t), t = (u − pivot)/reach, of a rational curve.
  struct Quotient {
    std::array<Polynomial, 3> position;
    Polynomial weight;
    Vec origin;
    double pivot = 0, reach = 1;
  };
  std::shared_ptr<const Orientation> orientation_;
  std::vector<std::unique_ptr<const Quotient>> quotients_;  ///< by segment; none of lines and arcs
};

}  // namespace bahnwerk
