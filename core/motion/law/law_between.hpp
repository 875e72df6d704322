#pragma once
/// A law through given states.
#include <cstddef>

#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Appends a piece from state to state (their jerks do not count): a quartic meets both speeds and accelerations for
/// any duration, and the way from `from.s` to `to.s` fixes its duration, close to the one given. O(1).
void append_between(TimeLaw& law, std::size_t segment, const LawState& from, const LawState& to, double duration);

}  // namespace bahnwerk
