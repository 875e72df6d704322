#include "core/redundant/known/reference_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/known/cycle_spline.hpp"
#include "core/redundant/known/split_peaks.hpp"

namespace bahnwerk {
namespace {

constexpr int most_passes = 200;
constexpr double longest = 100;       // largest factor of the first duration
constexpr double largest_step = 0.7;  // least factor of limits per pass
constexpr double beyond = 1e-3;       // relative decrease of limits beyond the quotients
constexpr double exceeded = 1e-5;     // relative excess of a limit that the plan removes by slowing the whole motion

/// Limits the factor by which limits fall in one pass, at both ends.
double fallen(double share, double use) {
  return use <= 1 + exceeded ? share : share * std::clamp((1 - beyond) / use, largest_step, 1 - beyond);
}

}  // namespace

Expected<RedundancyResult, NoPlan> search_reference(const RedundancyTask& task, const RedundancyOptions& options,
                                                    const FilterSearch& search, Progress progress) {
  const std::size_t axes = task.machine.axes.size();
  RedundancyTask stops = task;
  stops.rests.front() = stops.rests.back() = true;
  stops.dwells.insert(stops.dwells.begin(), Rest{0, search.lead, 0});
  stops.dwells.push_back(Rest{task.path->size(), search.tail, task.contour->blocks.size() - 1});
  AccelerationLimitedOptions law_options;
  law_options.corner_angle = options.corner_angle;
  law_options.keep_reserve = options.keep_reserve;
  law_options.braking_reserve = options.braking_reserve;
  ProgressScope scope(progress, "planning");
  RedundancyResult result;
  double velocity = 1, acceleration = 1;
  for (int pass = 0; pass < most_passes; ++pass) {
    Machine machine = summed(task.machine);
    for (AxisLimits& axis : machine.axes) axis.velocity *= velocity, axis.acceleration *= acceleration;
    const PathTask path{*task.path, machine, stops.feeds, stops.rests, stops.dwells};
    TimeLaw law =
        with_dwells(plan_acceleration_limited(path, law_options, progress.part(0, 0)).law, path, progress.part(0, 0));
    result.head = std::make_shared<const PathMotion>(task.path, std::move(law));
    const double moving = result.head->duration() - search.lead - search.tail;
    if (pass == 0) result.fastest = moving;
    if (moving > longest * result.fastest) break;
    const auto cells = static_cast<std::size_t>(std::ceil(result.head->duration() / task.machine.cycle_time));
    const double step = result.head->duration() / static_cast<double>(cells);
    std::vector<std::vector<double>> control = sampled(*result.head, cells);
    scope.work(cells);
    for (std::size_t k = 0; k < axes; ++k) control[k] = search.filter(control[k], step);
    result.coarse = std::make_shared<const SplineMotion>(cycle_spline(control, step));

    RedundancyIteration tried;
    tried.duration = result.head->duration();
    tried.peaks = split_peaks(*result.head, *result.coarse, scope);
    const SplitUse use = use_of(tried.peaks, task.machine);
    result.passes.push_back(std::move(tried));
    ++result.iterations;
    if (use.most() <= 1 + exceeded) return result;
    velocity = fallen(velocity, std::max({use.coarse_velocity, use.fine_velocity, use.offset}));
    acceleration = fallen(acceleration, std::max({use.coarse_acceleration, use.fine_acceleration, use.offset}));
  }
  return NoPlan::no_reference;
}

}  // namespace bahnwerk
