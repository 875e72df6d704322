#include "core/redundant/coarse/coarse_alone.hpp"

#include <cstdio>
#include <utility>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/coarse/coarse_task.hpp"

namespace bahnwerk {
namespace {

constexpr double margin = 1e-9;  // share of all limits that is left to rounding
constexpr double slower = 1e-9;  // largest relative difference of durations that counts as rounding

}  // namespace

RedundancyResult plan_coarse_alone(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                   double at) {
  AccelerationLimitedOptions law;
  law.corner_angle = options.corner_angle;
  law.keep_reserve = options.keep_reserve;
  law.braking_reserve = options.braking_reserve;
  // The fine axes stand, so the coarse ones take small steps of the tool's velocity as those of any machine do.
  const Machine coarse = coarse_machine(task.machine, 1 - margin);
  const PathTask path{*task.path, coarse, task.feeds, task.rests, task.dwells};
  RedundancyResult alone;
  alone.head = std::make_shared<const PathMotion>(
      task.path, with_dwells(plan_acceleration_limited(path, law, progress, at, at).law, path, progress, at));
  alone.coarse = alone.head;
  alone.fastest = alone.head->duration();
  return alone;
}

RedundancyResult quicker_than_coarse_alone(RedundancyResult found, const RedundancyTask& task,
                                           const RedundancyOptions& options, Progress& progress, double at) {
  if (!within_coarse_range(*task.path, task.machine)) return found;
  RedundancyResult alone = plan_coarse_alone(task, options, progress, at);
  const double own = found.head->duration(), other = alone.head->duration();
  if (own <= other * (1 + slower)) return found;
  char note[200];
  std::snprintf(
      note, sizeof note,
      "the method's own motion takes %.6g s, the coarse axes alone take %.6g s: they move alone, and the fine "
      "ones stand still",
      own, other);
  found.head = std::move(alone.head);
  found.coarse = std::move(alone.coarse);
  found.coarse_jerk_limited = false;
  found.trades.clear();
  found.lags.clear();
  found.slowed.clear();
  found.slowed_count = 0;
  found.gave_way.push_back({planner_name(options.method), GivingWay::slower, own, coarse_axes_alone, other});
  found.notes.emplace_back(note);
  RedundancyIteration last;
  last.duration = other;
  found.passes.push_back(std::move(last));
  return found;
}

}  // namespace bahnwerk
