#pragma once
/// Writes the phases of a straight move as consecutive pieces.
#include "core/motion/profile/profile.hpp"
#include "core/motion/profile/profile_change.hpp"

namespace bahnwerk {

/// Fills `profile` from its ends and turning speed: the change `first` from start_speed, a hold if the turning speed is
/// the limit, the change `second` to end_speed. Each change is computed from its lower speed, which keeps speeds near
/// zero accurate; the rest of rounding goes into the hold, or into the joint at the turning speed. O(pieces).
void lay_pieces(Profile& profile, const SpeedChange& first, const SpeedChange& second, const Limits& limits);

}  // namespace bahnwerk
