#pragma once
/// A piece of a law through two given states.
#include <cstddef>

#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Appends a piece from one state to another; their jerks are ignored. A quartic meets both speeds and accelerations
/// for any duration; the distance from `from.s` to `to.s` fixes the duration, close to the given one. O(1).
void append_between(TimeLaw& law, std::size_t segment, const LawState& from, const LawState& to, double duration);

}  // namespace bahnwerk
