#pragma once
/// Lays out the phases of a straight move one behind the other.
#include "core/motion/profile/profile.hpp"
#include "core/motion/profile/profile_change.hpp"

namespace bahnwerk {

/// Fills `profile` from its ends and turning speed: the change `first` from start_speed, a hold if the turning speed is
/// the limit, the change `second` to end_speed. Each change is laid from its lower speed, which keeps speeds near zero
/// accurate; what rounding leaves goes into the hold, or into the joint at the turning speed. O(pieces).
void lay_pieces(Profile& profile, const SpeedChange& first, const SpeedChange& second, const ProfileLimits& limits);

}  // namespace bahnwerk
