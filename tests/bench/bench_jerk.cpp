/// Time per grid point of the jerk-limited planner, path evaluation included, and how it grows.
/// Items are cells of the final grid, all rounds counted into their time.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/verify/bound/lower_bound.hpp"

namespace bahnwerk {
namespace {

/// One NURBS of n spans; degree 5 has continuous h‴.
Contour spline(int n, int degree) {
  std::vector<Vec> points;
  std::vector<double> knots(static_cast<std::size_t>(degree), 0);
  for (int i = 0; i < n + degree; ++i) points.push_back({6.0 * i, 8 * std::sin(1.3 * i), 0});
  for (int i = 0; i <= n; ++i) knots.push_back(i);
  knots.insert(knots.end(), static_cast<std::size_t>(degree), n);
  ContourBuilder b(2, points.front());
  b.block(Mode::cut, unlimited);
  b.nurbs(degree, points, std::vector<double>(points.size(), 1), knots);
  return b.finish();
}

const Machine m{{{"x", 1800, 16000, 1e6}, {"y", 1800, 16000, 1e6}}};

/// With so many points of the planner's grid.
Contour spline_of(std::int64_t points, int degree) {
  Progress progress;
  const std::size_t per_500 = plan_jerk_limited(spline(500, degree), m, {}, progress).cells;
  return spline(std::max(1, static_cast<int>(500 * static_cast<double>(points) / static_cast<double>(per_500))),
                degree);
}

void plan(benchmark::State& state, int degree) {
  Progress progress;
  const Contour contour = spline_of(state.range(0), degree);
  JerkLimitedResult result;
  for (auto _ : state) {
    result = plan_jerk_limited(contour, m, {}, progress);
    benchmark::DoNotOptimize(result.law.pieces().data());
  }
  const auto cells = static_cast<double>(result.cells);
  state.counters["points"] = cells;
  state.counters["iterations"] = static_cast<double>(result.iterations);
  state.counters["time_per_point"] =
      benchmark::Counter(cells, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["plan_s_per_motion_s"] = benchmark::Counter(
      result.law.duration(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(result.cells));
}

/// The bound of the same, per grid point of the plan.
void bound(benchmark::State& state, int degree) {
  Progress progress;
  const Contour contour = spline_of(state.range(0), degree);
  const JerkLimitedResult planned = plan_jerk_limited(contour, m, {}, progress);
  Bound low;
  for (auto _ : state) low = lower_bound(contour, m, 1e-3, progress);
  state.counters["gap"] = planned.law.duration() / low.value - 1;
  state.counters["time_per_point"] = benchmark::Counter(
      static_cast<double>(planned.cells), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(planned.cells));
}

BENCHMARK_CAPTURE(plan, cubic_spline, 3)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, quintic_spline, 5)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(bound, cubic_spline, 3)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Complexity(benchmark::oN)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk
