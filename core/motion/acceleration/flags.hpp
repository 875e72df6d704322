#pragma once
/// Flags of a grid's cells, few of which are set: the cells that a planner has to solve again. They are searched eight
/// at a time.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

using CellFlags = UnsetVector<std::uint8_t>;  ///< 0 or 1 per cell

inline constexpr std::size_t no_flag = static_cast<std::size_t>(-1);

/// Returns the first cell from `from` on that has its flag set, or no_flag. O(cells passed/8).
inline std::size_t first_set(const CellFlags& flags, std::size_t from) {
  const std::size_t n = flags.size();
  std::uint64_t eight = 0;
  while (from + sizeof eight <= n) {
    std::memcpy(&eight, &flags[from], sizeof eight);
    if (eight != 0) break;
    from += sizeof eight;
  }
  for (; from < n; ++from)
    if (flags[from] != 0) return from;
  return no_flag;
}

/// Returns the last cell before `end` that has its flag set, or no_flag. O(cells passed/8).
inline std::size_t last_set(const CellFlags& flags, std::size_t end) {
  std::uint64_t eight = 0;
  while (end >= sizeof eight) {
    std::memcpy(&eight, &flags[end - sizeof eight], sizeof eight);
    if (eight != 0) break;
    end -= sizeof eight;
  }
  for (; end > 0; --end)
    if (flags[end - 1] != 0) return end - 1;
  return no_flag;
}

}  // namespace bahnwerk
