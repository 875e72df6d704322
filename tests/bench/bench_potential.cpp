/// Time of the search for the most wires in the example stator slot, per wire size, and of one minimisation per wire,
/// with its growth. "wires" is the number found: a faster search that finds fewer is none.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/layout/potential.hpp"
#include "core/winding/packing/overlap_energy.hpp"

namespace bahnwerk::winding {
namespace {

/// The stator slot of [Herrmann Table 4.1] without its small roundings, with liner and wedge.
Region stator_room() {
  const double y = 95.48 - std::sqrt(95.48 * 95.48 - 2.9285 * 2.9285);
  const Point a{-2.9285, y}, b{2.9285, y}, c{2.22625, 16.129}, d{-2.22625, 16.129};
  const Region iron({arc_between({0, 95.48}, a, b, true), line(b, c), line(c, d), line(d, a)});
  const Point p{-1.8415, 15.709}, q{1.8415, 15.709}, r{1.8415, 17}, s{-1.8415, 17};
  return iron.inward(0.22).without(Region({line(p, q), line(q, r), line(r, s), line(s, p)}));
}

/// Thousandths of a millimetre: overall diameter, least overall diameter, copper (IEC 60317-0-1, grade 2, R 20).
void max_wires(benchmark::State& state) {
  const Region usable_area = stator_room();
  const double outer = 1e-3 * static_cast<double>(state.range(0)), least = 1e-3 * static_cast<double>(state.range(1));
  PotentialOptions options;
  options.overlap = 0.25 * (outer - least);
  Progress progress;
  std::size_t wires = 0;
  for (auto _ : state) wires = potential(usable_area, outer / 2, {}, options, progress).size();
  const double area = static_cast<double>(wires) * std::numbers::pi * outer * outer / 4;
  state.counters["wires"] = static_cast<double>(wires);
  state.counters["mechanical"] = area / usable_area.area();
}
BENCHMARK(max_wires)
    ->Args({566, 545})
    ->Args({630, 607})
    ->Args({704, 680})
    ->Args({789, 763})
    ->Args({884, 856})
    ->Args({989, 960})
    ->Args({1094, 1063})
    ->Args({1217, 1185})
    ->Args({1349, 1317})
    ->Args({1502, 1469})
    ->Args({1706, 1671})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// A descent from a random layout a little denser than possible.
void minimisation(benchmark::State& state) {
  const Region usable_area = stator_room();
  const auto count = static_cast<std::size_t>(state.range(0));
  const double radius = std::sqrt(0.86 * usable_area.area() / (static_cast<double>(count) * std::numbers::pi));
  Progress progress;
  const CentreArea centres(usable_area, radius, progress);
  const std::vector<Point> places = centres.spread(radius / 3);
  Random random(1);
  Minimiser minimiser;
  for (auto _ : state) {
    state.PauseTiming();
    OverlapEnergy energy(centres, 2 * radius);
    std::vector<Point> wires(count);
    for (Point& p : wires) p = places[random.below(places.size())];
    state.ResumeTiming();
    benchmark::DoNotOptimize(minimiser.minimise(energy, wires, 1e300, 600, progress).energy);
  }
  state.counters["time_per_wire"] = benchmark::Counter(
      static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(state.range(0));
}
BENCHMARK(minimisation)->RangeMultiplier(2)->Range(16, 2048)->Complexity()->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace bahnwerk::winding
