#pragma once
/// The constant feed: a change of speed from rest, one speed along the whole path, a change to rest [Herrmann 3.3.1,
/// 4.4.1]; and the parts that it shares with the feed per segment.
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/feed/feed_change.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The options of feeds that are constant in parts.
struct FeedOptions {
  SpeedProfile profile = SpeedProfile::double_s;
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad
  Limits path;                                               ///< limits along the tool's path
  /// The constant feed, mm/s, as given; 0 chooses the largest one that keeps all limits.
  double feed = 0;
  std::size_t nodes = 16;  ///< nodes of the grid per panel of the path
};

/// Thrown where the requested feed breaks a limit. The text names the limit, the largest feed and the place; `limit`
/// describes the limit that determines the largest feed.
struct FeedTooFast : Infeasible {
  FeedTooFast(const std::string& text, FeedLimit what, double asked_feed)
      : Infeasible(text), limit(what), asked(asked_feed) {}
  FeedLimit limit;  ///< the limit; limit.speed is the largest feed that it allows
  double asked;     ///< requested feed, mm/s
};

/// An interval of constant speed; FeedChanges finds the changes before and behind it.
struct FeedHold {
  double s0 = 0, s1 = 0;  ///< ends, mm; s0 = s1 with v = 0 is a rest
  double v = 0;           ///< mm/s
};

/// Writes the law between two places of rest that has each of `holds` in order, the first and last of which are rests,
/// with the fastest changes between them. Returns false where a change does not exist or does not fit.
bool write_feed(const FeedGrid& grid, SpeedProfile profile, const std::vector<FeedHold>& holds, TimeLaw& law);

/// Returns the largest speed ≤ `most`, and its interval, of a motion from rest at `begin` to rest at `end` with one
/// constant feed. The changes at both ends lower the feed where they do not fit, to 1e-9 of it. Throws Infeasible if no
/// feed fits.
FeedHold largest_feed(const FeedGrid& grid, SpeedProfile profile, double begin, double end, double most);

/// Plans one feed for the whole path, with rest at both ends, at the task's rests and at corners. The largest feed is
/// the least of FeedGrid::hold(), ends of the path included, if its changes fit. Throws FeedTooFast, Infeasible for a
/// path that only rest can pass, InvalidInput where neither acceleration nor jerk is limited, Stopped. Cost: that of
/// the grid, about 0.1 ms per segment.
TimeLaw plan_constant_feed(const PathTask& task, const FeedOptions& options, Progress progress);
/// Plans the feed on an existing grid.
TimeLaw constant_feed(const FeedGrid& grid, const FeedOptions& options);

}  // namespace bahnwerk
