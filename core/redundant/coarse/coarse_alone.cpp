#include "core/redundant/coarse/coarse_alone.hpp"

#include <utility>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/coarse/coarse_task.hpp"

namespace bahnwerk {
namespace {

constexpr double margin = 1e-9;  // share of all limits that is left to rounding

TimeLaw law_of(const PathTask& path, int order, const RedundancyOptions& options, Progress progress) {
  if (order == 3) {
    JerkLimitedOptions law;
    law.corner_angle = options.corner_angle;
    return plan_jerk_limited(path, law, progress).law;
  }
  AccelerationLimitedOptions law;
  law.corner_angle = options.corner_angle;
  law.keep_reserve = options.keep_reserve;
  law.braking_reserve = options.braking_reserve;
  return plan_acceleration_limited(path, law, progress).law;
}

}  // namespace

RedundancyResult plan_coarse_alone(const RedundancyTask& task, const RedundancyOptions& options, Progress progress) {
  // The fine axes stand, so the coarse ones take small steps of the tool's velocity as those of any machine do.
  const Machine coarse = coarse_machine(task.machine, 1 - margin);
  const PathTask path{*task.path, coarse, task.feeds, task.rests, task.dwells};
  const int order = task.machine.limited_order();
  RedundancyResult alone;
  alone.head = std::make_shared<const PathMotion>(task.path,
                                                  with_dwells(law_of(path, order, options, progress), path, progress));
  alone.coarse = alone.head;
  alone.fastest = alone.head->duration();
  alone.coarse_jerk_limited = order == 3;
  alone.passes.push_back({alone.fastest, 0, {}});
  return alone;
}

}  // namespace bahnwerk
