#pragma once
/// Finding stretches of a path that may be the same curve at another place: by a number that such stretches share.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "core/geometry/path/path.hpp"

namespace bahnwerk {

/// Of the segments [first, last): equal for stretches that are moved copies of each other, up to rounding (two copies
/// in about 10⁴ come out different all the same). Equal numbers prove nothing. O(1).
std::uint64_t rough_shape(const Path& path, std::size_t first, std::size_t last);

/// What was seen of each number: the latest few of the indices that were added.
class RoughIndex {
 public:
  /// The latest first. Valid until the next add().
  std::span<const std::size_t> of(std::uint64_t shape) const;
  void add(std::uint64_t shape, std::size_t index);

 private:
  static constexpr std::size_t kept = 4;
  struct Latest {
    std::size_t count = 0;
    std::array<std::size_t, kept> index{};
  };
  std::unordered_map<std::uint64_t, Latest> seen_;
};

}  // namespace bahnwerk
