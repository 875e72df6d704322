#pragma once
/// A constant feed per piece of the path, with changes of speed between: the heuristic of critical points [Herrmann
/// 4.4.2, (4.71)–(4.73)].
///
/// Each cell (a segment of the path, or an even part of one) has its own largest feed, FeedGrid::hold(): that of the
/// segment (chord error and curvature, core/motion/feed/curvature_feed.hpp), of the limits along the path and of the
/// axes. Cells are taken slowest first. Each is given a hold at its feed between the holds that there are already,
/// from and to which a change leads in all limits: rising behind the slower one, falling before it, over as many
/// segments as it needs. A cell that is too short for that, or too close to a slower one, has no hold, and is passed
/// within changes; where it lies between two holds that are far enough apart for a higher speed, that is reached. So
/// nothing has to be taken back where a segment is too short to brake, and what has been laid can always be driven.
///
/// More cells follow the limits more closely, but leave less room between two holds. And where a feed takes all that
/// the axes have, nothing is left to start a change with, least of all one whose acceleration jumps. So segments are
/// planned whole, in 4 and in 16 cells, each with all and with 0.93 of what the axes allow, and the quickest law is
/// taken: of these six and of the constant feed.
///
/// Against the source: the axes' limits count, in the feeds and in the changes; a change goes on over joints; the
/// acceleration of a change is what the axes leave to it where it is.
#include "core/motion/feed/constant_feed.hpp"

namespace bahnwerk {

/// At rest at both ends of the path, and where the task rests or the path has corners. Never slower than
/// plan_constant_feed() under the same limits. Throws what that throws. Cost: about 1.2 ms per segment through a
/// machine's kinematics.
TimeLaw plan_critical_points(const PathTask& task, const FeedOptions& options, Progress& progress, double from,
                             double to);

}  // namespace bahnwerk
