#pragma once
/// What is known per cell of a grid, carried over when cells are divided.
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
  while (from < to) {  // what lies before the first divided cell stays where it is
    --from;
    pulse(parts.size() - from, parts.size());
    for (std::size_t i = parts[from]; i > 0; --i) values[--to] = values[from];
  }
}

}  // namespace bahnwerk
