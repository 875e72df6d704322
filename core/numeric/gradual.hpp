#pragma once
/// Step lengths of a Newton step that vary along a banded problem. A single step length would be shortened everywhere
/// by one tight row. Here each place has its own, and it rises only gradually from one place to the next, because the
/// step's linear equations are violated by the difference of neighbouring step lengths.
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// Returns the largest step length next to `part`. L is a number, or a vector of one per lane.
template <class L>
L next_part(L part) {
  constexpr double slope = 0.02, growth = 1.05;
  return smaller(part + slope, part * growth);
}

}  // namespace bahnwerk
