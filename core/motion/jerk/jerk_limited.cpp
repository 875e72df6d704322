#include "core/motion/jerk/jerk_limited.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/grid/section_repeats.hpp"
#include "core/motion/jerk/section.hpp"

namespace bahnwerk {

namespace {

template <int N, int M>
JerkLimitedResult plan(const PathTask& task, const JerkLimitedOptions& options, Progress progress) {
  const LanePath<N> path(task.path);
  const Machine lanes = path.limits(task.machine);
  ProgressScope stage_progress(progress.part(0, 0), "planning");
  const Sections sections = find_sections(task, options.corner_angle, stage_progress);
  JerkLimitedResult result;
  JerkSectionPlanner<N, M> planner(path, lanes, options, task.feeds, sections);
  const auto plan_section = [&](std::size_t first, std::size_t last, Progress part) {
    const double before = planner.work();
    planner.plan(first, last, part, result);
    return planner.work() - before;
  };
  const double work = for_each_section_once(task, sections, progress, result, plan_section);
  if (result.cells > 0)
    result.iterations = static_cast<std::size_t>(std::lround(work / static_cast<double>(result.cells)));
  return result;
}

}  // namespace

JerkLimitedResult plan_jerk_limited(const PathTask& task, const JerkLimitedOptions& options, Progress progress) {
  std::vector<InputFault> faults;
  for (const AxisLimits& axis : task.machine.axes)
    if (!(axis.velocity > 0) || !(axis.acceleration > 0) || !std::isfinite(axis.acceleration) || !(axis.jerk > 0))
      faults.push_back(
          {{"machine", "axes", axis.name}, "velocity, acceleration and jerk must be positive, acceleration finite"});
  const Limits& along = options.path;
  if (!(along.velocity > 0) || !(along.acceleration > 0) || !(along.jerk > 0))
    faults.push_back({{"planning"}, "limits along the path must be positive"});
  if (!faults.empty()) throw InvalidInput(faults);
  const bool path = std::isfinite(options.path.acceleration) || std::isfinite(options.path.jerk);
  return with_lanes(task.path.axes(), [&](auto n) {
    constexpr int N = n();
    return path ? plan<N, N + 1>(task, options, progress) : plan<N, N>(task, options, progress);
  });
}

JerkLimitedResult plan_jerk_limited(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                                    Progress progress) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return plan_jerk_limited(contour_task(path, contour, machine), options, progress);
}

}  // namespace bahnwerk
