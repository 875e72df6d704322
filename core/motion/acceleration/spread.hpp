#pragma once
/// What is known per cell of a grid, carried over when cells are divided.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/base/progress_scope.hpp"
#include "core/numeric/grow.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// Makes room for divided cells in what is known per cell: each part gets what its cell had. `values` may hold one
/// more, which stays the last. O(cells).
template <class Values>
void spread(Values& values, const LargeVector<std::uint8_t>& parts, std::size_t cells, ProgressScope& pulse) {
  std::size_t from = values.size(), to = from + cells - parts.size();
  grow(values, to, pulse);
  values.resize(to);
  while (from > parts.size()) values[--to] = values[--from];
  constexpr std::size_t block = 4096;
  while (from < to) {          // what lies before the first divided cell stays where it is
    std::size_t begin = from;  // of a run of cells that stay whole
    for (const std::size_t least = from > block ? from - block : 0; begin > least && parts[begin - 1] == 1;) --begin;
    pulse.work(1 + (from - begin) / 16);
    if (begin < from) {
      const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
      std::move_backward(at(begin), at(from), at(to));
      to -= from - begin;
      from = begin;
      continue;
    }
    --from;
    for (std::size_t i = parts[from]; i > 0; --i) values[--to] = values[from];
  }
}

}  // namespace bahnwerk
