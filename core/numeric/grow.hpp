#pragma once
/// Growth of large arrays in a job that may be stopped at any time: a vector that outgrows its memory copies itself at
/// once, and the system may take milliseconds for each large page that is written first.
#include <algorithm>
#include <cstddef>
#include <utility>

namespace bahnwerk {

/// Makes room for at least `least` values, and half as many again as there are; calls pulse.report() while it copies.
/// O(values) if they need new memory.
template <class Values, class Pulse>
void grow(Values& values, std::size_t least, Pulse& pulse) {
  if (least <= values.capacity()) return;
  constexpr std::size_t block = std::size_t{1} << 14;
  Values larger;
  larger.reserve(std::max(least, values.size() + values.size() / 2));
  for (std::size_t i = 0; i < values.size(); i += block) {
    pulse.report();
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i);
    larger.insert(larger.end(), begin, begin + static_cast<std::ptrdiff_t>(std::min(block, values.size() - i)));
  }
  values.swap(larger);
}

/// How much room all will need, and a little more, when `values` are what the first `part` of it needs, 0 to 1: no more
/// than 1 500 times that, and just that where nothing is known. Room that is not used costs nothing, growing again
/// does.
inline std::size_t foreseen(std::size_t values, double part) {
  constexpr double reserve = 1.5, most_ahead = 1500;
  if (!(part > 0)) return values;
  return static_cast<std::size_t>(static_cast<double>(values) * std::min(reserve / part, most_ahead));
}

}  // namespace bahnwerk
