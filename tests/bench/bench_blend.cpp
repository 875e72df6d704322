/// Time per segment of blending and of the check of the tube, and how they grow.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/blend.hpp"
#include "core/contour/polyline.hpp"
#include "core/numeric/random.hpp"
#include "core/verify/geometry/tube.hpp"
#include "tests/support/machines.hpp"

namespace bahnwerk {
namespace {

/// Chords of 0.05 mm of a winding curve, rounded to 1 µm: one run.
Contour chords(std::int64_t n) {
  std::vector<Vec> points;
  Vec at;
  for (std::int64_t i = 0; i <= n; ++i) {
    points.push_back({std::round(at.x * 1e3) * 1e-3, std::round(at.y * 1e3) * 1e-3, 0});
    const double heading = 2 * std::sin(0.004 * static_cast<double>(i)) + std::sin(0.0011 * static_cast<double>(i));
    at += 0.05 * Vec{std::cos(heading), std::sin(heading), 0};
  }
  return polyline(2, points, false, unlimited);
}

/// Lines of 0.2 to 2 mm that turn by up to `turn`.
Contour walk(std::int64_t n, double turn) {
  Random random(7);
  std::vector<Vec> points{{}};
  double heading = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    heading += random.uniform(-turn, turn);
    points.push_back(points.back() + random.uniform(0.2, 2) * Vec{std::cos(heading), std::sin(heading), 0});
  }
  return polyline(2, points, false, unlimited);
}

enum Kind { chord_contour, mixed_contour, corner_contour };
Contour make(Kind kind, std::int64_t n) {
  return kind == chord_contour ? chords(n) : walk(n, kind == mixed_contour ? 0.3 : 2.5);
}

void finish(benchmark::State& state) {
  state.counters["time_per_segment"] = benchmark::Counter(
      static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(state.range(0));
}

void blending(benchmark::State& state, Kind kind) {
  const Contour given = make(kind, state.range(0));
  const Machine machine = bahnwerk::testing::two_axes();
  Progress progress;
  std::size_t pieces = 0;
  for (auto _ : state) {
    const Contour path = blend(given, {0.02}, machine, progress);
    pieces = path.path.size();
    benchmark::DoNotOptimize(pieces);
  }
  state.counters["pieces"] = static_cast<double>(pieces);
  finish(state);
}

void checking(benchmark::State& state, Kind kind) {
  const Contour given = make(kind, state.range(0));
  Progress progress;
  const Contour path = blend(given, {0.02}, bahnwerk::testing::two_axes(), progress);
  for (auto _ : state) {
    const Check check = tube_checks(given, path, 0.02, progress).back();
    if (!check.passed) state.SkipWithError("outside the tube");
  }
  finish(state);
}

#define SIZES RangeMultiplier(10)->Range(1000, 100000)->Complexity(benchmark::oAuto)->Unit(benchmark::kMillisecond)
BENCHMARK_CAPTURE(blending, chords, chord_contour)->SIZES;
BENCHMARK_CAPTURE(blending, mixed, mixed_contour)->SIZES;
BENCHMARK_CAPTURE(blending, corners, corner_contour)->SIZES;
BENCHMARK_CAPTURE(checking, chords, chord_contour)->SIZES;
BENCHMARK_CAPTURE(checking, mixed, mixed_contour)->SIZES;
BENCHMARK_CAPTURE(checking, corners, corner_contour)->SIZES;

}  // namespace
}  // namespace bahnwerk
