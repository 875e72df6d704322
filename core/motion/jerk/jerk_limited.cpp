#include "core/motion/jerk/jerk_limited.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/grid/section_repeats.hpp"
#include "core/motion/jerk/section.hpp"
#include "core/motion/law/repeated_law.hpp"

namespace bahnwerk {

namespace {

template <int N, int M>
JerkLimitedResult plan(const PathTask& task, const JerkLimitedOptions& options, Progress& progress, double from,
                       double to) {
  const LanePath<N> path(task.path);
  const Machine lanes = path.limits(task.machine);
  ProgressScope scope(progress, "planning", from, from), repeating(progress, "planning", from, to);
  const Sections sections = find_sections(task, options.corner_angle, scope);
  JerkLimitedResult result;
  JerkSectionPlanner<N, M> planner(path, lanes, options, task.feeds, sections, progress);
  SectionRepeats repeats(task, sections, repeating);
  struct Before {  // each section, and at the end
    std::size_t pieces, cells;
    double work;
  };
  std::vector<Before> before;
  double work = 0;
  std::size_t i = 0;
  for_each_section(path.tool(), sections, from, to, [&](std::size_t first, std::size_t last, double begin, double end) {
    repeating.done(to > from ? (begin - from) / (to - from) : 1);
    before.push_back({result.law.pieces().size(), result.cells, work});
    const std::size_t source = last == first + 1 && path.linear(first) ? i : repeats.source(i);
    if (source == i) {
      const double done = planner.work();
      planner.plan(first, last, begin, end, result);
      work += planner.work() - done;
    } else {
      const Before &a = before[source], &b = before[source + 1];
      repeat_law(result.law, a.pieces, b.pieces, path.tool(), sections.begin[source], first, last - first, repeating);
      result.cells += b.cells - a.cells;
      work += b.work - a.work;
    }
    ++i;
  });
  if (result.cells > 0)
    result.iterations = static_cast<std::size_t>(std::lround(work / static_cast<double>(result.cells)));
  return result;
}

}  // namespace

JerkLimitedResult plan_jerk_limited(const PathTask& task, const JerkLimitedOptions& options, Progress& progress,
                                    double from, double to) {
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
    return path ? plan<N, N + 1>(task, options, progress, from, to) : plan<N, N>(task, options, progress, from, to);
  });
}

JerkLimitedResult plan_jerk_limited(const Contour& contour, const Machine& machine, const JerkLimitedOptions& options,
                                    Progress& progress, double from, double to) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return plan_jerk_limited(contour_task(path, contour, machine), options, progress, from, to);
}

}  // namespace bahnwerk
