// What verifying costs per law piece and bounding per node, for growing plans.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/motion/setpoints/contour_setpoints.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "core/verify/law/verifier.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"
#include "tests/core/motion/setpoints/slowed.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::machine;
using reference::Maker;

enum Shape : int { lines, arcs, cubics };

// A wave of `periods` periods, 40 mm each: one shape only, all joints tangent (lines: corners).
Contour wave(Shape shape, int periods) {
  Maker make;
  for (int i = 0; i < periods; ++i) {
    const double x = 40.0 * i;
    if (shape == lines) make.line({x + 20, 10}).line({x + 40, 0});
    if (shape == arcs) make.arc({x + 20, 0}, {x + 10, 0}, false).arc({x + 40, 0}, {x + 30, 0}, true);
    if (shape == cubics)
      make.bezier({{x + 8, 9}, {x + 12, 9}, {x + 20, 0}}, {1, 1.2, 0.9, 1})
          .bezier({{x + 28, -9}, {x + 32, -9}, {x + 40, 0}});
  }
  return make.done();
}

// Even pieces that speed up and slow down a little, at rest wherever segments meet at corners.
TimeLaw wavy_law(const Contour& contour, std::size_t pieces) {
  const std::size_t n = contour.path.size(), each = std::max<std::size_t>(2, pieces / n);
  std::vector<reference::Stop> stops;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < each; ++k)
      stops.push_back(
          {contour.path[i].s0() + contour.path[i].length() * double(k) / double(each),
           k == 0 && (i == 0 || contour.path[i].straight()) ? 0 : 100 + 0.1 * double((k * 7919 + i * 131) % 100)});
  stops.push_back({contour.path.length(), 0});
  return reference::law_through(contour.path, stops);
}

void verifying(benchmark::State& state, Shape shape) {
  const auto pieces = static_cast<std::size_t>(state.range(0));
  const Contour contour = wave(shape, static_cast<int>(std::max<std::size_t>(1, pieces / 200)));
  const TimeLaw law = wavy_law(contour, pieces);
  const Machine m = machine(2, 1800, 16000);
  Progress silent;
  for (auto _ : state) benchmark::DoNotOptimize(verify_motion({contour, m, law, 1e-3}, silent));
  state.counters["per_piece"] = benchmark::Counter(
      double(law.pieces().size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(verifying, lines, lines)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(verifying, arcs, arcs)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(verifying, cubics, cubics)->RangeMultiplier(10)->Range(1000, 100000)->Unit(benchmark::kMillisecond);

// Reading rows alone (check = false), or checking them, which reads them too.
void rows(benchmark::State& state, Shape shape, bool check) {
  const Contour contour = wave(shape, static_cast<int>(state.range(0)));
  const Machine m = machine(2, 1800, 16000, 1e-4);
  const TimeLaw law = wavy_law(contour, 200 * contour.path.size());
  const Cycles cycles = whole_cycles(law.duration(), m.cycle_time);
  const auto motion = test::slowed(contour, m, law, cycles);
  const ContourSetpoints source(motion, contour, m, cycles.count);
  std::vector<double> chunk(1024 * source.columns().size());
  Progress silent;
  for (auto _ : state) {
    if (check) {
      benchmark::DoNotOptimize(setpoint_checks({motion->path(), m, motion->law(), source, &contour}, silent));
      continue;
    }
    for (std::size_t first = 0; first < source.count(); first += 1024) {
      source.read(first, std::min<std::size_t>(1024, source.count() - first), chunk.data());
      benchmark::DoNotOptimize(chunk.data());
    }
  }
  state.counters["rows"] = double(source.count());
  state.counters["per_row"] = benchmark::Counter(
      double(source.count()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(rows, read_lines, lines, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rows, check_lines, lines, true)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rows, read_arcs, arcs, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rows, check_arcs, arcs, true)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rows, read_cubics, cubics, false)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(rows, check_cubics, cubics, true)->Arg(100)->Unit(benchmark::kMillisecond);

void bounding(benchmark::State& state, Shape shape) {
  const Contour contour = wave(shape, static_cast<int>(state.range(0)));
  const Machine m = machine(2, 1800, 16000);
  Progress silent;
  Bound bound;
  for (auto _ : state) bound = lower_bound(contour, m, 1e-3, silent);
  const double nodes = std::atof(bound.basis.substr(bound.basis.find_first_of("0123456789")).c_str());
  state.counters["nodes"] = nodes;
  state.counters["per_node"] =
      benchmark::Counter(nodes, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(bounding, lines, lines)->RangeMultiplier(10)->Range(10, 10000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bounding, arcs, arcs)->RangeMultiplier(10)->Range(3, 300)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bounding, cubics, cubics)->RangeMultiplier(10)->Range(3, 300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk
