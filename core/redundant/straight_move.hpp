#pragma once
/// A section that is one straight line from rest to rest, and how fast its head may go there: more slowly than both
/// axes together could, so that the coarse axes can follow.
///
/// A lower feed alone does not help a coarse axis that starts from rest: then accelerations have to fall, and not
/// necessarily by as much at both ends. The coarse axes of a lone move of length L stand S ahead of the tool at its
/// begin and S behind it at its end, and a head with L/(L − 2S) times their velocity and acceleration is as quick as
/// they are over L − 2S: the least time there is.
///
/// Coarse axes that have to be slow behind a move brake before the head does. From there on the fine axes drive it by
/// themselves, with what they have left of their acceleration besides the coarse axes' braking: so between rise and
/// fall the speed need not stay, and rises on with that `slope`; or falls, likewise, where they had to be slow before.
#include <cstddef>
#include <optional>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

/// What the head of a straight move is planned with.
struct Pace {
  double feed = 0;            ///< mm/s; with a slope the speed where that begins, or ends if it is below 0
  double rise = 0, fall = 0;  ///< mm/s², most acceleration and most braking
  double slope = 0;           ///< mm/s², acceleration between them; 0 where jerk is limited
};

struct StraightMove {
  double begin = 0, length = 0;  ///< mm, along the path
  std::size_t segment = 0;
  Pace fastest, slowest;             ///< with both axes, and with the coarse axes alone, whatever comes before or after
  double jerk_per_acceleration = 0;  ///< 1/s: jerk falls with acceleration; infinite where it is not limited
  double reserve = 0;  ///< mm/s², what the head can accelerate with while all coarse axes brake; not above 0: nothing
};

/// The segments [first, last) as a straight move, if they are one. `head`: limits it is planned with.
std::optional<StraightMove> straight_move(const AxisPath& path, const CoarseFineMachine& machine, const Machine& head,
                                          double feed, std::size_t first, std::size_t last);

/// How long it takes at that pace, s, jerk apart. O(1).
double duration_of(const StraightMove& move, const Pace& pace);
/// The pace with that feed replaced by the one for a duration, the highest where that is too short. O(1).
Pace lasting(const StraightMove& move, Pace pace, double duration);
/// Appends its quickest law at that pace. O(1).
void append_move(TimeLaw& law, const StraightMove& move, const Pace& pace);

}  // namespace bahnwerk
