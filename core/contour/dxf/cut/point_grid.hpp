#pragma once
/// Points hashed by their cell in a regular grid, for queries of near points. O(1) per point and query while cells hold
/// few points. A query evaluates at most `max_looks` points per cell (the last ones added), so that a million points at
/// one place cost linear time.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/curve/vec.hpp"

namespace bahnwerk {

/// Points with their numbers in the order of add().
class PointGrid {
 public:
  static constexpr std::size_t max_looks = 256;

  /// The grid expects about `expected` points and queries of this radius, mm (at least 1e-9).
  PointGrid(double radius, std::size_t expected)
      : radius_(std::max(radius, 1e-9)),
        inverse_(0.25 / radius_),
        heads_(std::bit_ceil(2 * expected + 2), none),
        mask_(heads_.size() - 1) {}

  void add(Vec p) {
    const std::size_t cell = slot({index(p.x), index(p.y), index(p.z)});
    next_.push_back(heads_[cell]);
    points_.push_back(p);
    heads_[cell] = static_cast<std::uint32_t>(points_.size() - 1);
  }

  /// Calls visit(i, distance) for the points i within the radius, in the order in which they were added, until it
  /// returns false.
  template <class Visit>
  void near(Vec p, Visit visit) const {
    std::array<std::size_t, 8> seen;
    std::size_t cells = 0;
    for (std::int64_t x = index(p.x - radius_); x <= index(p.x + radius_); ++x)
      for (std::int64_t y = index(p.y - radius_); y <= index(p.y + radius_); ++y)
        for (std::int64_t z = index(p.z - radius_); z <= index(p.z + radius_); ++z) {
          const std::size_t cell = slot({x, y, z});
          // Two cells may share a slot, whose points are visited once.
          bool again = false;
          for (std::size_t i = 0; i < cells; ++i) again = again || seen[i] == cell;
          if (again || cells == seen.size()) continue;
          seen[cells++] = cell;
          std::size_t looks = 0;
          for (std::uint32_t i = heads_[cell]; i != none && looks < max_looks; i = next_[i], ++looks) {
            const double distance = norm(points_[i] - p);
            if (distance <= radius_ && !visit(static_cast<std::size_t>(i), distance)) return;
          }
        }
  }

 private:
  static constexpr std::uint32_t none = UINT32_MAX;

  /// The grid is shifted by half a cell, so that integers do not lie on borders, and its cells are 4 radii wide, so
  /// that a query meets at most 2 per axis.
  std::int64_t index(double x) const {
    constexpr double largest = 4e18;  // points beyond this index share one cell
    return static_cast<std::int64_t>(std::clamp(std::floor(x * inverse_ + 0.5), -largest, largest));
  }
  std::size_t slot(std::array<std::int64_t, 3> cell) const {
    std::uint64_t h = 0;
    for (const std::int64_t i : cell) {
      h = (h ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h) & mask_;
  }

  double radius_, inverse_;
  std::vector<std::uint32_t> heads_, next_;
  std::size_t mask_;
  std::vector<Vec> points_;
};

}  // namespace bahnwerk
