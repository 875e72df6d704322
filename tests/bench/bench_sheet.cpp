/// Time per hole of a sheet of equal holes, bound and verification of motion and setpoints included: it should hardly
/// depend on how long one hole takes to plan.
#include <benchmark/benchmark.h>

#include "core/base/progress.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/motion/sheet.hpp"

namespace bahnwerk {
namespace {

const Machine m{{{"x", 1800, 16000, 1e6}, {"y", 1800, 16000, 1e6}}, 0.001};

void sheet(benchmark::State& state, PlanningMethod method, test::Hole hole) {
  const auto holes = static_cast<int>(state.range(0));
  const Contour contour = test::sheet(hole, 0, holes);
  ContourPlanning planning;
  planning.method = method;
  Progress progress;
  for (auto _ : state) benchmark::DoNotOptimize(plan_contour(contour, m, planning, progress).duration);
  state.counters["per_hole"] =
      benchmark::Counter(holes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

#define SIZES Arg(1)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(sheet, time_optimal_circles, PlanningMethod::time_optimal, test::Hole::circle)->SIZES;
BENCHMARK_CAPTURE(sheet, jerk_limited_circles, PlanningMethod::jerk_limited, test::Hole::circle)->SIZES;
BENCHMARK_CAPTURE(sheet, time_optimal_slots, PlanningMethod::time_optimal, test::Hole::slot)->SIZES;
BENCHMARK_CAPTURE(sheet, jerk_limited_slots, PlanningMethod::jerk_limited, test::Hole::slot)->SIZES;

}  // namespace
}  // namespace bahnwerk
