/// Time per point of the shortest probe path and of its bound: points on a helix, and points at random.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/probe/optimal/optimal.hpp"
#include "core/verify/probe/probe_bound.hpp"

namespace bahnwerk {
namespace {

enum Kind { helix, random_points };

ProbeProblem problem(Kind kind, std::int64_t points) {
  ProbeProblem p;
  p.tolerance = 0.05;
  p.speed = 20;
  for (const char* name : {"x", "y", "z"}) {
    AxisLimits axis(name, unlimited, 200, 4000);
    axis.snap = 200000;
    p.machine.axes.push_back(axis);
  }
  Random random(1);
  Vec at{};
  for (std::int64_t i = 0; i < points; ++i) {
    const double angle = 0.01 * static_cast<double>(i);
    if (kind == helix)
      at = {20 * std::cos(angle), 20 * std::sin(angle), 0.01 * static_cast<double>(i)};
    else
      at = at + Vec{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    p.given.push_back(at);
  }
  merge_points(p);
  return p;
}

void shortest(benchmark::State& state) {
  const ProbeProblem p = problem(static_cast<Kind>(state.range(0)), state.range(1));
  Progress silent;
  double duration = 0;
  for (auto _ : state) duration = plan_optimal(p, silent).duration();
  state.counters["duration"] = duration;
  state.SetItemsProcessed(state.iterations() * state.range(1));
}
void bounded(benchmark::State& state) {
  const ProbeProblem p = problem(static_cast<Kind>(state.range(0)), state.range(1));
  Progress silent;
  double duration = 0;
  for (auto _ : state) duration = probe_bound(p, silent).value;
  state.counters["duration"] = duration;
  state.SetItemsProcessed(state.iterations() * state.range(1));
}
BENCHMARK(shortest)->ArgsProduct({{helix, random_points}, {10, 128, 100000 / 10}})->Unit(benchmark::kMillisecond);
BENCHMARK(bounded)->ArgsProduct({{helix, random_points}, {10, 128}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk
