#include "core/redundant/coarse_alone.hpp"

#include <cstdio>
#include <utility>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/law/dwell.hpp"

namespace bahnwerk {
namespace {

constexpr double margin = 1e-9;  // of all limits: rounding
constexpr double slower = 1e-9;  // relative, that counts as none

}  // namespace

RedundancyResult plan_coarse_alone(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                   double at) {
  Machine machine;
  machine.cycle_time = task.machine.cycle_time;
  for (const CoarseFineAxis& axis : task.machine.axes)
    machine.axes.emplace_back(axis.name, (1 - margin) * axis.coarse.velocity, (1 - margin) * axis.coarse.acceleration);
  AccelerationLimitedOptions law;
  law.corner_angle = options.corner_angle;
  law.keep_reserve = options.keep_reserve;
  law.braking_reserve = options.braking_reserve;
  PathTask path{*task.path, machine, task.feeds, task.rests, task.dwells};
  // The fine axes stand, so the coarse ones take every step of the tool's velocity: they rest at all of them.
  for (std::size_t i = 1; i < task.path->size(); ++i)
    if (stops_at(task.path->tool(), i, 1e-8)) path.rests[i] = true;
  RedundancyResult alone;
  alone.head = std::make_shared<const PathMotion>(
      task.path, with_dwells(plan_acceleration_limited(path, law, progress, at, at).law, path, progress, at));
  alone.coarse = alone.head;
  alone.fastest = alone.head->duration();
  return alone;
}

RedundancyResult quicker_than_coarse_alone(RedundancyResult found, const RedundancyTask& task,
                                           const RedundancyOptions& options, Progress& progress, double at) {
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
  found.fallbacks += 1;
  found.notes.emplace_back(note);
  RedundancyIteration last;
  last.duration = other;
  found.passes.push_back(std::move(last));
  return found;
}

}  // namespace bahnwerk
