/// Time of a feed plan per segment of the path: the grid, one feed for all, a feed per piece.
#include <benchmark/benchmark.h>

#include "core/base/progress.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "core/motion/feed/critical_points.hpp"
#include "tests/core/machine/winders.hpp"
#include "tests/core/motion/axes/needle_loop.hpp"

namespace bahnwerk {
namespace {

/// So many turns about a stator, on the horizontal winder; items are segments of the path, four per turn.
struct Turns {
  test::NeedlePath path;
  MachinePath machine;
  Machine limits;
  PathTask task;
  explicit Turns(int turns)
      : path(test::stator_turns(turns)),
        machine(machine_path(path.tool, path.orientation, {test::horizontal()})),
        limits{machine.kinematics->axes(), 0.002},
        task{*machine.axes, limits, std::vector<double>(path.tool.size(), unlimited),
             std::vector<bool>(path.tool.size() + 1, false)} {
    task.rests.front() = task.rests.back() = true;
  }
};

template <class Plan>
void feed(benchmark::State& state, Plan&& plan) {
  const Turns turns(static_cast<int>(state.range(0)));
  Progress silent;
  for (auto _ : state) benchmark::DoNotOptimize(plan(turns.task, FeedOptions{}, silent));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(turns.path.tool.size()));
  state.SetComplexityN(state.range(0));
}

BENCHMARK_CAPTURE(feed, constant, plan_constant_feed)->RangeMultiplier(4)->Range(1, 64)->Complexity();
BENCHMARK_CAPTURE(feed, critical_points, plan_critical_points)->RangeMultiplier(4)->Range(1, 64)->Complexity();

}  // namespace
}  // namespace bahnwerk
