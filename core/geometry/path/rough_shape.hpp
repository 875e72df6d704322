#pragma once
/// Finds sequences of segments that may be moved copies of each other, by a number that copies share.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "core/geometry/path/path.hpp"

namespace bahnwerk {

/// Returns a number of the segments [first, last) that is equal for moved copies, up to rounding (for about 2 in 10⁴
/// copies it differs). Equal numbers prove nothing. O(1).
std::uint64_t rough_shape(const Path& path, std::size_t first, std::size_t last);

/// Stores the latest four indices that were added for each number.
class RoughIndex {
 public:
  /// Returns the indices, the latest first. The result is valid until the next add().
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
