#pragma once
/// A section that consists of one straight line from rest to rest, and limits under which the coarse axes can follow
/// the head there.
///
/// A lower feed alone does not help a coarse axis that starts from rest; accelerations have to fall as well, possibly
/// by different amounts at both ends. If the coarse axes of a single move of length L stand S ahead of the tool at its
/// begin and S behind it at its end, they travel L − 2S. A head with L/(L − 2S) times their velocity and acceleration
/// then takes as long as they do, which is the least time.
#include <cstddef>
#include <optional>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

/// Limits of the head on a straight move.
struct Pace {
  double feed = 0;            ///< mm/s, largest speed
  double rise = 0, fall = 0;  ///< mm/s², largest acceleration and largest deceleration
};

struct StraightMove {
  double begin = 0, length = 0;  ///< mm, along the path
  std::size_t segment = 0;
  Pace fastest, slowest;             ///< limits of both stages, and of the coarse axes alone, for a single move
  double jerk_per_acceleration = 0;  ///< 1/s, ratio of jerk and acceleration limit; infinite if jerk is not limited
};

/// Returns the segments [first, last) as a straight move if they form one line. `head` are the limits that the head is
/// planned with, `feed` is in mm/s.
std::optional<StraightMove> straight_move(const AxisPath& path, const CoarseFineMachine& machine, const Machine& head,
                                          double feed, std::size_t first, std::size_t last);

/// Returns the move's duration at `pace`, s, without regard to jerk limits. O(1).
double duration_of(const StraightMove& move, const Pace& pace);
/// Returns `pace` with the feed for which the move takes `duration` s; the highest feed if that is too short. O(1).
Pace lasting(const StraightMove& move, Pace pace, double duration);
/// Appends the quickest time law of the move at `pace`. O(1).
void append_move(TimeLaw& law, const StraightMove& move, const Pace& pace);

}  // namespace bahnwerk
