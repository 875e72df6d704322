#pragma once
/// The constant feed: from rest by a profile to one speed, at that along the whole path, by the profile to rest
/// [Herrmann 3.3.1, 4.4.1]; and what it shares with the feed per segment.
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/motion/feed/feed_change.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct FeedOptions {
  SpeedProfile profile = SpeedProfile::double_s;
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad
  Limits path;                                               ///< the tool's path
  /// Of the constant feed, mm/s: this one and no other; 0: the largest one that keeps all limits.
  double feed = 0;
  std::size_t nodes = 16;  ///< of the grid, per panel of the path
};

/// The feed that was asked for breaks a limit. Its text names it, the largest feed and the place; `limit` tells what
/// holds that down.
struct FeedTooFast : Infeasible {
  FeedTooFast(const std::string& text, FeedLimit what, double asked_feed)
      : Infeasible(text), limit(what), asked(asked_feed) {}
  FeedLimit limit;  ///< its speed is the largest feed
  double asked;
};

/// A stretch of constant speed; the changes before and behind it are found by FeedChanges.
struct FeedHold {
  double s0 = 0, s1 = 0;  ///< mm; a place of rest where both are the same and v = 0
  double v = 0;           ///< mm/s
};

/// Between two places of rest: the law that holds each of `holds` in order, the first and last of which are rests, with
/// the quickest changes between. None where a change is not found or has no room.
bool write_feed(const FeedGrid& grid, SpeedProfile profile, const std::vector<FeedHold>& holds, TimeLaw& law);

/// The largest speed of a motion from rest at `begin` to rest at `end` with one constant feed of `most` at most,
/// together with where it is held. The changes at both ends lower the feed where they do not fit otherwise: to 1e-9 of
/// it. Throws Infeasible where nothing fits.
FeedHold largest_feed(const FeedGrid& grid, SpeedProfile profile, double begin, double end, double most);

/// At rest at both ends of the path, and where the task rests or the path has corners: one feed for all of it. The
/// largest one is the least of FeedGrid::hold(), ends of the path included, if its changes fit. Throws FeedTooFast,
/// Infeasible for a path that only rest can pass, InvalidInput where neither acceleration nor jerk is limited, Stopped.
/// Cost: that of the grid, about 0.1 ms per segment.
TimeLaw plan_constant_feed(const PathTask& task, const FeedOptions& options, Progress& progress, double from,
                           double to);
/// The same on a grid that is there.
TimeLaw constant_feed(const FeedGrid& grid, const FeedOptions& options);

}  // namespace bahnwerk
