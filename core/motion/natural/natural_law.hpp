#pragma once
/// The natural feed: a curve is passed at constant parameter speed, u = λ t, so that its speed follows from its
/// parametrisation [Herrmann 3.3.1, natural interpolation].
///
/// Between pieces that join only geometrically the parameter's speed jumps, and at its ends the motion would start and
/// stop at full speed. Only curves with a share (free links) are therefore passed in this manner, each with the λ that
/// gives all of them one mean speed. The pieces between them (lines, arcs) are passed at that mean speed, which cubics
/// in time connect with the links, with continuous acceleration and with the durations that need the least acceleration
/// and jerk. Finally the law is slowed until all limits hold. This leaves nothing to optimise; other feeds are
/// quicker.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The options of plan_natural().
struct NaturalOptions {
  /// Share of each segment in its link's parameter, 0 between links. Consecutive segments with shares belong to one
  /// link until their shares add up to 1.
  std::vector<double> shares;
  std::size_t steps = 64;  ///< pieces of the law per segment
  Limits path;             ///< limits along the tool's path
};

/// Plans a law that rests at both ends and at the task's rests, none of which is within a link. Limits hold along the
/// whole path, between samples, too (core/motion/law/law_excess.hpp). O(segments · steps). Throws Infeasible where the
/// pieces between two links are so short that no cubic connects their speeds; std::invalid_argument for inconsistent
/// shares.
TimeLaw plan_natural(const PathTask& task, const NaturalOptions& options, Progress progress);

}  // namespace bahnwerk
