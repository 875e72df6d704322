#pragma once
/// Step lengths of a Newton step that vary along a banded problem. One tight row would shorten the step of a long
/// problem everywhere; so each place has its own step length, and step lengths rise only gradually from one place to
/// the next. Where they differ, the step's linear equations are violated by their difference.
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// Returns the largest step length next to `part`. L is a number, or a vector of one per lane.
template <class L>
L next_part(L part) {
  constexpr double slope = 0.02, growth = 1.05;
  return smaller(part + slope, part * growth);
}

}  // namespace bahnwerk
