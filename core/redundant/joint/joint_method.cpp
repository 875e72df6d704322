#include "core/redundant/joint/joint_method.hpp"

#include <utility>

#include "core/redundant/joint/joint.hpp"

namespace bahnwerk {

RedundancyResult plan_joint_method(const RedundancyTask& task, const RedundancyOptions& options, Progress& progress,
                                   double from, double to) {
  JointOptions given;
  given.smoothness = options.smoothness;
  given.stretch = options.stretch;
  given.compare = options.compare;
  given.coarse_alone = options.coarse_alone;
  given.least_stroke = options.least_stroke;
  given.bound = task.bound;
  given.corner_angle = options.corner_angle;
  JointResult found =
      plan_joint({task.path, task.machine, task.feeds, task.rests, task.dwells}, given, progress, from, to);
  RedundancyResult result;
  result.head = std::move(found.head);
  result.coarse = std::move(found.coarse);
  result.fastest = found.fastest;
  result.iterations = found.iterations;
  result.certified = found.certified;
  result.slowed_count = found.slowed;
  result.coarse_jerk_limited = task.machine.limits_jerk();
  if (found.gave_way) {
    if (!options.coarse_alone)
      result.gave_way.push_back(
          {planner_name(RedundancyMethod::joint), GivingWay::no_motion, 0, coarse_axes_alone, result.head->duration()});
    result.notes.emplace_back(
        "no motion was found in which the fine axes take part: they stand still, and the coarse axes move alone");
  }
  if (found.slower > 0) {
    result.gave_way.push_back({planner_name(RedundancyMethod::joint), GivingWay::slower, found.slower,
                               coarse_axes_alone, result.head->duration()});
    result.notes.emplace_back(
        "the coarse axes alone are quicker than every motion that was found in which the fine axes take part: those "
        "stand still");
  }
  const double planned = found.chosen.duration / found.chosen.stretch;
  result.passes.push_back({found.fastest, found.slowed, {}});
  if (found.slowed > 0) result.passes.push_back({planned, 0, {}});
  for (Trade& trade : found.trades) result.trades.push_back({trade.stretch, trade.duration, std::move(trade.energy)});
  return result;
}

}  // namespace bahnwerk
