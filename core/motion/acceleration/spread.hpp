#pragma once
/// Transfers values per cell of a grid to the parts when cells are divided.
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/base/progress_scope.hpp"
#include "core/numeric/grow.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// Spreads values over divided cells: each part gets the value of its cell. `values` may hold one more value, which
/// stays the last one. O(cells).
template <class Values>
void spread(Values& values, const LargeVector<std::uint8_t>& parts, std::size_t cells, ProgressScope& progress) {
  std::size_t from = values.size(), to = from + cells - parts.size();
  grow(values, to, progress);
  values.resize(to);
  while (from > parts.size()) values[--to] = values[--from];
  constexpr std::size_t block = 4096;
  while (from < to) {          // values before the first divided cell stay in place
    std::size_t begin = from;  // beginning of a run of cells that are not divided
    for (const std::size_t least = from > block ? from - block : 0; begin > least && parts[begin - 1] == 1;) --begin;
    progress.work(1 + (from - begin) / 16);
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
