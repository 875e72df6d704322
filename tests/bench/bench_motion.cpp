/// Time per grid point of the acceleration-limited planners, path evaluation included, and how it grows.
/// Items are cells of the final grid, all rounds of refinement counted into their time.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

/// A smooth rosette of arcs: one run, every joint tangential.
Contour arcs(int n) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, unlimited);
  Vec at{};
  double heading = 0;
  for (int i = 0; i < n; ++i) {
    const double side = i % 2 ? 1 : -1, sweep = side * (1.5 + 0.3 * std::sin(i)), r = 10 + 5 * std::cos(2.0 * i);
    const Vec centre = at + r * Vec{std::cos(heading + side * M_PI / 2), std::sin(heading + side * M_PI / 2), 0};
    const Vec d = at - centre;
    const Vec to =
        centre + Vec{std::cos(sweep) * d.x - std::sin(sweep) * d.y, std::sin(sweep) * d.x + std::cos(sweep) * d.y, 0};
    b.arc(to, centre, side > 0);
    at = to;
    heading += sweep;
  }
  return b.finish();
}

/// One cubic NURBS of n spans, or with weights.
Contour spline(int n, bool rational) {
  std::vector<Vec> points;
  std::vector<double> weights, knots(3, 0);
  for (int i = 0; i < n + 3; ++i) {
    points.push_back({6.0 * i, 8 * std::sin(1.3 * i), 0});
    weights.push_back(rational && i % 2 ? 1.3 : 1);
  }
  for (int i = 0; i <= n; ++i) knots.push_back(i);
  knots.insert(knots.end(), 3, n);
  ContourBuilder b(2, points.front());
  b.block(Mode::cut, unlimited);
  b.nurbs(3, points, weights, knots);
  return b.finish();
}

enum Kind { arc_contour, cubic_contour, rational_contour };

void plan(benchmark::State& state, Kind kind, bool reserve, bool refine) {
  const auto wanted = static_cast<double>(state.range(0));
  // Segments enough for about the wanted number of cells at the default fineness.
  AccelerationLimitedOptions options;
  options.keep_reserve = reserve;
  if (!refine) options.max_divisions = options.max_rounds = 0;
  const Machine m = bahnwerk::testing::two_axes();
  Progress progress;
  auto make = [&](int n) { return kind == arc_contour ? arcs(n) : spline(n, kind == rational_contour); };
  const std::size_t per_50 = plan_acceleration_limited(make(50), m, options, progress).cells;
  const Contour contour = make(std::max(1, static_cast<int>(50 * wanted / static_cast<double>(per_50))));
  std::size_t cells = 0, rounds = 0;
  // The first plan of a size also pays for fresh memory, which the next ones find again (core/numeric/large_pages.hpp).
  double duration = plan_acceleration_limited(contour, m, options, progress).law.duration();
  for (auto _ : state) {
    const auto result = plan_acceleration_limited(contour, m, options, progress);
    cells = result.cells;
    rounds = result.rounds;
    duration = result.law.duration();
    benchmark::DoNotOptimize(duration);
  }
  state.counters["points"] = static_cast<double>(cells);
  state.counters["rounds"] = static_cast<double>(rounds);
  state.counters["time_per_point"] = benchmark::Counter(
      static_cast<double>(cells), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["plan_s_per_motion_s"] =
      benchmark::Counter(duration, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(cells));
}

#define SIZES RangeMultiplier(10)->Range(1000, 1000000)->Complexity(benchmark::oAuto)->Unit(benchmark::kMillisecond)
// One solution on a given grid, what planners are usually compared by …
BENCHMARK_CAPTURE(plan, time_optimal_arcs_fixed_grid, arc_contour, false, false)->SIZES;
BENCHMARK_CAPTURE(plan, time_optimal_cubic_spline_fixed_grid, cubic_contour, false, false)->SIZES;
BENCHMARK_CAPTURE(plan, time_optimal_nurbs_fixed_grid, rational_contour, false, false)->SIZES;
BENCHMARK_CAPTURE(plan, braking_reserve_nurbs_fixed_grid, rational_contour, true, false)->SIZES;
// … and all that a plan needs to be within 1e-5 of converged, per point of the final grid.
BENCHMARK_CAPTURE(plan, time_optimal_arcs, arc_contour, false, true)->SIZES;
BENCHMARK_CAPTURE(plan, time_optimal_cubic_spline, cubic_contour, false, true)->SIZES;
BENCHMARK_CAPTURE(plan, time_optimal_nurbs, rational_contour, false, true)->SIZES;
BENCHMARK_CAPTURE(plan, braking_reserve_arcs, arc_contour, true, true)->SIZES;
BENCHMARK_CAPTURE(plan, braking_reserve_nurbs, rational_contour, true, true)->SIZES;

}  // namespace
}  // namespace bahnwerk
