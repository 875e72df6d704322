// ns per cycle of every interpolator along a rational curve of degree 5: a walk through all rows; one row found from
// its number; and with what measures the feed's fluctuation.
#include <benchmark/benchmark.h>

#include <string>

#include "core/base/progress.hpp"
#include "core/motion/interpolation/interpolation.hpp"
#include "tests/core/motion/interpolation/moved.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t cycles = 2000;

Interpolation interpolation(benchmark::State& state) {
  const auto& row = interpolators[static_cast<std::size_t>(state.range(0))];
  state.SetLabel(row.name);
  const test::Moved moved = test::from_rest_to_rest(test::path_of({test::quintic()}), cycles, 0.002);
  static std::shared_ptr<const Path> kept;
  kept = moved.path;
  Progress progress;
  ProgressScope stage_progress(progress, "bench");
  return {moved.motion, row.value, moved.cycle_time, cycles, stage_progress};
}

void step(benchmark::State& state) {
  const Interpolation rows = interpolation(state);
  Interpolation::Row row = rows.row(0);
  for (auto _ : state) {
    if (row.index + 1 == cycles) row = rows.row(0);
    rows.advance(row);
    benchmark::DoNotOptimize(row);
  }
}
BENCHMARK(step)->DenseRange(0, 3);

void find_row(benchmark::State& state) {
  const Interpolation rows = interpolation(state);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(rows.row(i = (i + 613) % cycles));
}
BENCHMARK(find_row)->DenseRange(0, 3);

void with_fluctuation(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(interpolation(state));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cycles));
}
BENCHMARK(with_fluctuation)->DenseRange(0, 3);

}  // namespace
}  // namespace bahnwerk
