#pragma once
/// Parts of a Newton step that differ along a banded problem. One tight row would hold up a long problem everywhere; so
/// each place takes the part that it can, but parts rise only gradually from one to the next: where they differ the
/// step's linear equations hold no longer, by as much as they differ from place to place.
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// The largest part next to one that takes `part`. A number, or one per lane.
template <class L>
L next_part(L part) {
  constexpr double slope = 0.02, growth = 1.05;
  return smaller(part + slope, part * growth);
}

}  // namespace bahnwerk
