#include "core/redundant/joint/joint_method.hpp"

#include <utility>

#include "core/redundant/joint/joint.hpp"

namespace bahnwerk {

Expected<RedundancyResult, NoPlan> plan_joint_method(const RedundancyTask& task, const RedundancyOptions& options,
                                                     Progress progress) {
  JointOptions given;
  given.smoothness = options.smoothness;
  given.stretch = options.stretch;
  given.compare = options.compare;
  given.least_stroke = options.least_stroke;
  given.bound = task.bound;
  given.corner_angle = options.corner_angle;
  Expected<JointResult, NoPlan> found =
      plan_joint({task.path, task.machine, task.feeds, task.rests, task.dwells}, given, progress);
  if (!found) return found.reason();
  RedundancyResult result;
  result.head = std::move(found->head);
  result.coarse = std::move(found->coarse);
  result.fastest = found->fastest;
  result.iterations = found->iterations;
  result.certified = found->certified;
  result.slowed_count = found->slowed;
  result.coarse_jerk_limited = task.machine.limited_order() == 3;
  const double planned = found->chosen.duration / found->chosen.stretch;
  result.passes.push_back({found->fastest, found->slowed, {}});
  if (found->slowed > 0) result.passes.push_back({planned, 0, {}});
  for (Trade& trade : found->trades) result.trades.push_back({trade.stretch, trade.duration, std::move(trade.energy)});
  return result;
}

}  // namespace bahnwerk
