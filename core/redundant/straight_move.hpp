#pragma once
/// A section that is one straight line from rest to rest, and how fast its head may go there: more slowly than both
/// axes together could, so that the coarse axes can follow.
///
/// A lower feed alone does not help a coarse axis that starts from rest: then accelerations have to fall, and not
/// necessarily by as much at both ends. The coarse axes of a lone move of length L stand S ahead of the tool at its
/// begin and S behind it at its end, and a head with L/(L − 2S) times their velocity and acceleration is as quick as
/// they are over L − 2S: the least time there is.
#include <cstddef>
#include <optional>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/redundant/coarse_fine.hpp"

namespace bahnwerk {

/// What the head of a straight move is planned with.
struct Pace {
  double feed = 0;            ///< mm/s
  double rise = 0, fall = 0;  ///< mm/s², most acceleration and most braking
};

struct StraightMove {
  double begin = 0, length = 0;  ///< mm, along the path
  std::size_t segment = 0;
  Pace fastest, slowest;             ///< with both axes, and with the coarse axes alone, whatever comes before or after
  double jerk_per_acceleration = 0;  ///< 1/s: jerk falls with acceleration; infinite where it is not limited
};

/// The segments [first, last) as a straight move, if they are one. `head`: limits it is planned with.
std::optional<StraightMove> straight_move(const AxisPath& path, const CoarseFineMachine& machine, const Machine& head,
                                          double feed, std::size_t first, std::size_t last);

/// Appends its quickest law at that pace. O(1).
void append_move(TimeLaw& law, const StraightMove& move, const Pace& pace);

}  // namespace bahnwerk
