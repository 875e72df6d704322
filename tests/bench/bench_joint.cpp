/// Time per cell of the split of a head's motion, and how it grows: the interior-point method alone, and the whole plan
/// of a sheet of holes.
#include <benchmark/benchmark.h>

#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/redundant/chain/chain_solver.hpp"
#include "core/redundant/head/following.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

/// With about so many cells.
JointTask sheet(std::int64_t cells) {
  const int rows = std::max(1, static_cast<int>(cells / 3800));
  return test::joint_task(test::holes(cells < 3800 ? static_cast<int>(cells / 95) : 40, rows, 25, 6), test::md2());
}

void solution(benchmark::State& state) {
  const JointTask task = sheet(state.range(0));
  Progress progress;
  Machine machine = head_limits(task.machine);
  for (AxisLimits& axis : machine.axes) axis.acceleration *= 1 - 1e-7;
  const PathMotion head(
      task.path, plan_acceleration_limited(PathTask{*task.path, machine, task.feeds, task.rests}, {}, progress).law);
  HeadCellOptions options;
  for (const AxisLimits& axis : machine.axes) {
    options.held.push_back(axis);
    options.acceleration_change.push_back(3000);
    options.jerk_change.push_back(unlimited);
    options.jerk_range.push_back(unlimited);
  }
  options.longest = chain_units(task.machine.axes[0]).time / 24;
  ProgressScope stage_progress(progress, "bench");
  const HeadCells cells = head_cells(head, options, stage_progress);
  const Chain<2> chain = following<2>(cells, 0, task.machine.axes[0]).value();
  ChainSolution<2> s;
  for (auto _ : state) s = solve(chain, {});
  state.counters["cells"] = static_cast<double>(cells.size());
  state.counters["iterations"] = s.iterations;
  state.counters["excess"] = s.excess;
  state.counters["time_per_cell"] = benchmark::Counter(
      static_cast<double>(cells.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(cells.size()));
}

void plan(benchmark::State& state) {
  const JointTask task = sheet(state.range(0));
  Progress progress;
  JointResult r;
  for (auto _ : state) r = *plan_joint(task, {}, progress);
  state.counters["cells"] = static_cast<double>(r.cells);
  state.counters["gap"] = r.chosen.duration / r.fastest - 1;
  state.counters["plan_s_per_motion_s"] = benchmark::Counter(
      r.chosen.duration, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(r.cells));
}

BENCHMARK(solution)->RangeMultiplier(10)->Range(1000, 100000)->Complexity(benchmark::oN)->Unit(benchmark::kMillisecond);
BENCHMARK(plan)->RangeMultiplier(10)->Range(1000, 100000)->Complexity(benchmark::oN)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk
