#pragma once
/// Paths under a rigid motion or a reflection.
#include <array>

#include "core/geometry/path/path.hpp"

namespace bahnwerk {

/// p ↦ (rows[0] · p, rows[1] · p, rows[2] · p) + offset, with orthonormal rows: lengths and angles stay as they are.
struct Isometry {
  std::array<Vec, 3> rows{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  Vec offset;
  Vec turned(Vec direction) const {
    return {dot(rows[0], direction), dot(rows[1], direction), dot(rows[2], direction)};
  }
  Vec operator()(Vec point) const { return turned(point) + offset; }
};

/// Returns the image of a curve, over the same parameter.
std::shared_ptr<const Curve> turned(const Curve& curve, const Isometry& map);

/// Returns the image of a path: the same segments in the same order, with their sources. O(segments · degree).
Path turned(const Path& path, const Isometry& map);

}  // namespace bahnwerk
