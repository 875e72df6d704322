#pragma once
/// A constant feed per piece of the path, with changes of speed between pieces: the heuristic of critical points
/// [Herrmann 4.4.2, (4.71)–(4.73)].
///
/// Each cell (a segment of the path, or an equal part of one) has its own largest feed, FeedGrid::hold(): that of the
/// segment (chord error and curvature, core/motion/feed/curvature_feed.hpp), of the limits along the path and of the
/// axes. Cells are planned slowest first. Each gets a hold at its feed between the existing holds, connected by changes
/// within all limits: rising behind the slower one, falling before it, over as many segments as needed. A cell that is
/// too short for that, or too close to a slower one, has no hold and is passed within changes; between two holds that
/// are far enough apart for a higher speed, that speed is reached. A speed therefore never has to be lowered later
/// because a segment is too short to brake, and every intermediate law can be driven.
///
/// More cells follow the limits more closely but leave less distance between two holds. Where a feed uses the axes in
/// full, no change can start, least of all one whose acceleration jumps. Segments are therefore planned whole, in 4 and
/// in 16 cells, each with all and with 0.93 of the axes' limits; the fastest law of these six and of the constant feed
/// is the result.
///
/// Deviations from the source: the axes' limits count, in feeds and in changes; a change may extend over joints; the
/// acceleration of a change is what the axes allow at its place.
#include "core/motion/feed/constant_feed.hpp"

namespace bahnwerk {

/// Plans with rest at both ends of the path, at the task's rests and at corners. The result is never slower than
/// plan_constant_feed() under equal limits, and it throws what that throws. Cost: about 1.2 ms per segment through a
/// machine's kinematics.
TimeLaw plan_critical_points(const PathTask& task, const FeedOptions& options, Progress progress);

}  // namespace bahnwerk
