#include "core/redundant/known/split_plan.hpp"

#include <cmath>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/axes/hermite_motion.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/known/split_peaks.hpp"

namespace bahnwerk {
namespace {

constexpr double first_margin = 1e-6, last_margin = 0.1;  // relative margins of all limits
constexpr double exceeded = 1e-5;         // relative excess of a peak that the plan removes by slowing the whole motion
constexpr double grid_loss = 2e-7;        // relative: the cells of a path depend a little on the order of its axes
constexpr double longest_piece = 0.5e-3;  // s, longest piece of the coarse motion

}  // namespace

Expected<RedundancyResult, NoPlan> plan_split(const RedundancyTask& task,
                                              const std::shared_ptr<const CoarsePath>& coarse, double longest_cell,
                                              const RedundancyOptions& options, Progress progress) {
  const auto axes = std::make_shared<const SplitPath>(task.path, coarse);
  AccelerationLimitedOptions law_options;
  law_options.corner_angle = options.corner_angle;
  law_options.keep_reserve = options.keep_reserve;
  law_options.braking_reserve = options.braking_reserve;
  law_options.grid.longest = longest_cell;
  law_options.tolerance = grid_loss;
  RedundancyResult result;
  for (double margin = first_margin; margin <= last_margin;) {
    const Machine machine = both_stages(task.machine, 1 - margin);
    const PathTask path{*axes, machine, task.feeds, task.rests, task.dwells};
    ++result.iterations;
    TimeLaw law = with_dwells(plan_acceleration_limited(path, law_options, progress.part(0, 0.5)).law, path,
                              progress.part(0.5, 0.5));
    ProgressScope scope(progress.part(0.5, 1), "planning");
    const PathMotion motion(axes, law);
    result.coarse =
        std::make_shared<const SplineMotion>(hermite_motion(motion, 0, task.machine.axes.size(), longest_piece));
    result.head = std::make_shared<const PathMotion>(task.path, std::move(law));
    RedundancyIteration pass;
    pass.duration = result.head->duration();
    pass.peaks = split_peaks(*result.head, *result.coarse, scope);
    SplitUse use = use_of(pass.peaks, task.machine);
    use.offset = 0;  // slowing does not reduce offsets
    result.passes.push_back(std::move(pass));
    if (result.passes.size() == 1) result.fastest = result.head->duration();
    if (use.most() <= 1 + exceeded) return result;
    margin = std::fmax(10 * margin, 1.2 * (use.most() - 1));
  }
  return NoPlan::between_samples;
}

}  // namespace bahnwerk
