#pragma once
/// The natural feed: curves are passed evenly in their own parameter, u = λ t, so that their speed is what their
/// parameter makes it [Herrmann 3.3.1, natural interpolation].
///
/// Between pieces that join only geometrically the parameter's speed jumps, and at its ends the motion would start and
/// stop at full speed. So only curves with a share (free links) are passed evenly, each at its own λ, with which its
/// mean speed is that of all others; what lies between (lines, arcs) is passed at that mean speed, from and to which
/// cubics in time lead, continuous in acceleration, of the durations that ask least of the machine. Then everything is
/// slowed until the limits hold: that leaves nothing to choose, and is why other feeds are planned.
#include <cstddef>
#include <vector>

#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct NaturalOptions {
  /// Per segment: which share of its link's parameter it takes, 0 for what lies between links. Segments with shares
  /// that follow each other belong to one link until their shares add up to 1.
  std::vector<double> shares;
  std::size_t steps = 64;  ///< pieces of the law per segment
  Limits path;             ///< the tool's path
};

/// At rest at both ends and at the task's rests, which are not within links. Limits hold all along the path, between
/// samples, too (core/motion/law/law_excess.hpp). O(segments · steps). Throws Infeasible where what lies between two
/// links is so short that no cubic leads from its speed to the next; std::invalid_argument for shares that do not fit.
TimeLaw plan_natural(const PathTask& task, const NaturalOptions& options, Progress& progress, double from, double to);

}  // namespace bahnwerk
