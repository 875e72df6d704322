#include "core/motion/feed/constant_feed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/motion/feed/feed_law.hpp"

namespace bahnwerk {
namespace {

constexpr double resolution = 1e-9;   // resolution of a feed, relative
constexpr double least_feed = 1e-6;   // mm/s: what is slower is no motion
constexpr double exactly = 1 + 1e-9;  // a requested feed may equal the largest one but for rounding

/// Finds both changes of a motion at one feed; returns false if they do not fit.
bool fits(const FeedChanges& changes, double begin, double end, double v, FeedHold& hold) {
  const auto rise = changes.find(begin, 0, v, true, end - begin);
  if (!rise) return false;
  const auto fall = changes.find(end, 0, v, false, end - rise->far_end());
  if (!fall) return false;
  hold = {rise->far_end(), fall->far_end(), v};
  return true;
}

/// Returns the limit that determines the largest feed over [s0, s1].
FeedLimit slowest(const FeedGrid& grid, double s0, double s1) {
  const Path& tool = grid.task().path.tool();
  FeedLimit least;
  for (std::size_t i = tool.find(s0); i < tool.size() && (tool[i].s0() < s1 || i == tool.find(s0)); ++i)
    if (grid.hold(i).speed < least.speed) least = grid.hold(i);
  return least;
}

}  // namespace

bool write_feed(const FeedGrid& grid, SpeedProfile profile, const std::vector<FeedHold>& holds, TimeLaw& law) {
  const FeedChanges changes(grid, profile);
  FeedLawWriter writer(law, grid.task().path.tool(), holds.front().s0);
  const double slack = 1e-14 * grid.task().path.length();  // rounding of the places of holds
  for (std::size_t i = 0; i + 1 < holds.size(); ++i) {
    const FeedHold &here = holds[i], &next = holds[i + 1];
    const double room = next.s0 - here.s1 + slack;
    if (here.v < next.v) {
      const auto change = changes.find(here.s1, here.v, next.v, true, room);
      if (!change) return false;
      writer.change(*change, std::min(change->far_end(), next.s0));
    } else if (here.v > next.v) {
      const auto change = changes.find(next.s0, next.v, here.v, false, room);
      if (!change) return false;
      writer.hold(here.v, change->far_end());
      writer.change(*change, next.s0);
    }
    if (next.v > 0) writer.hold(next.v, next.s1);
  }
  return true;
}

FeedHold largest_feed(const FeedGrid& grid, SpeedProfile profile, double begin, double end, double most) {
  const FeedChanges changes(grid, profile);
  FeedHold hold;
  if (fits(changes, begin, end, most, hold)) return hold;
  double too_fast = most, feed = 0;
  for (double less = 1e-6; feed == 0; less *= 4) {
    const double tried = most * std::max(1 - less, 0.5 / (1 + less));
    if (tried < least_feed) {
      char text[160];
      std::snprintf(text, sizeof text, "constant feed: no feed gets from rest at %.6g mm to rest at %.6g mm", begin,
                    end);
      throw Infeasible(text);
    }
    if (fits(changes, begin, end, tried, hold)) {
      feed = tried;
    } else {
      too_fast = tried;
    }
  }
  while (too_fast - feed > resolution * too_fast) {
    const double middle = feed + (too_fast - feed) / 2;
    FeedHold found;
    if (fits(changes, begin, end, middle, found)) {
      feed = middle, hold = found;
    } else {
      too_fast = middle;
    }
  }
  return hold;
}

TimeLaw constant_feed(const FeedGrid& grid, const FeedOptions& options) {
  const PathTask& task = grid.task();
  const Path& tool = task.path.tool();
  const auto& sections = grid.sections().begin;
  FeedLimit limit = slowest(grid, 0, tool.length());
  if (!(limit.speed >= least_feed)) {
    char text[200];
    std::snprintf(text, sizeof text, "constant feed: %s leaves no speed at %.6g mm along the path",
                  in_words(limit, task.machine).c_str(), limit.s);
    throw Infeasible(text);
  }
  const auto end_of = [&](std::size_t i) {
    return sections[i + 1] < tool.size() ? tool[sections[i + 1]].s0() : tool.length();
  };
  const auto every_section = [&](double most) {
    for (std::size_t i = 0; i + 1 < sections.size(); ++i)
      most = largest_feed(grid, options.profile, tool[sections[i]].s0(), end_of(i), most).v;
    return most;
  };
  const double largest = limit.speed;
  double feed = every_section(options.feed > 0 ? std::min(options.feed, largest) : largest);
  if (options.feed > feed * exactly) {
    const bool changes_limit = feed < largest;
    limit.speed = options.feed > largest ? every_section(largest) : feed;
    char text[400];
    std::snprintf(text, sizeof text,
                  "%.6g mm/s are too fast for %s at %.6g mm along the path; the largest constant feed is %.10g mm/s",
                  options.feed,
                  changes_limit ? "the changes of speed from and to rest" : in_words(limit, task.machine).c_str(),
                  limit.s, limit.speed);
    throw FeedTooFast(text, limit, options.feed);
  }
  TimeLaw law;
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    const double begin = tool[sections[i]].s0(), end = end_of(i);
    const FeedHold hold = largest_feed(grid, options.profile, begin, end, feed);
    if (!write_feed(grid, options.profile, {{begin, begin, 0}, hold, {end, end, 0}}, law))
      throw Infeasible("constant feed: a change of speed that was found does not fit");
  }
  return law;
}

TimeLaw plan_constant_feed(const PathTask& task, const FeedOptions& options, Progress progress) {
  ProgressScope stage_progress(progress, "constant feed");
  stage_progress.report();
  const FeedGrid grid(task,
                      {options.nodes, speed_profile_row(options.profile).order, options.corner_angle, options.path},
                      stage_progress);
  TimeLaw law = constant_feed(grid, options);
  stage_progress.done(1);
  stage_progress.report();
  return law;
}

}  // namespace bahnwerk
