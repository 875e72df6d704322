#pragma once
/// Growth of large arrays in a job that may be stopped at any time. A std::vector that outgrows its memory copies
/// itself at once, and the system may take milliseconds for each large page on its first write.
#include <algorithm>
#include <cstddef>
#include <utility>

namespace bahnwerk {

/// Reserves memory for at least `least` values and at least 1.5 times the present ones; calls progress.report() while
/// it copies. O(values) if new memory is needed.
template <class Values, class Pulse>
void grow(Values& values, std::size_t least, Pulse& progress) {
  if (least <= values.capacity()) return;
  constexpr std::size_t block = std::size_t{1} << 14;
  Values larger;
  larger.reserve(std::max(least, values.size() + values.size() / 2));
  for (std::size_t i = 0; i < values.size(); i += block) {
    progress.report();
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i);
    larger.insert(larger.end(), begin, begin + static_cast<std::ptrdiff_t>(std::min(block, values.size() - i)));
  }
  values.swap(larger);
}

/// Returns the expected number of values of the whole, and a little more, if `values` are those of its first `part`, 0
/// to 1: at most 1 500 times `values`, and `values` itself where nothing is known. Unused memory costs nothing, growing
/// again does.
inline std::size_t foreseen(std::size_t values, double part) {
  constexpr double reserve = 1.5, most_ahead = 1500;
  if (!(part > 0)) return values;
  return static_cast<std::size_t>(static_cast<double>(values) * std::min(reserve / part, most_ahead));
}

}  // namespace bahnwerk
