/// Time per wire of layouts laid one wire after another, and of the check whether they hold. The stator's slot is
/// scaled so that it takes the wanted number of wires; a needle winding's time covers all four regions.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/laying/producible.hpp"
#include "core/winding/layout/orthocyclic.hpp"
#include "core/winding/layout/raabe.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

/// Wires of about this number fill the slot: 0.82 of the area is what the layouts reach.
double radius_for(const Slot& slot, double wires) {
  return std::sqrt(0.82 * slot.usable_area.area() / (3.14159 * wires));
}

void count(benchmark::State& state, std::size_t wires) {
  state.counters["wires"] = static_cast<double>(wires);
  state.counters["time_per_wire"] = benchmark::Counter(
      static_cast<double>(wires), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(wires));
}

void stator_needle(benchmark::State& state) {
  const Slot slot = make_slot(StatorSlot{});
  const double r = radius_for(slot, static_cast<double>(state.range(0)));
  std::size_t wires = 0;
  for (auto _ : state) wires = needle(slot, r, StatorHeads{}, silent)[0].wires.size();
  count(state, wires);
}
void stator_raabe(benchmark::State& state) {
  const Slot slot = make_slot(StatorSlot{});
  const double r = radius_for(slot, static_cast<double>(state.range(0)));
  std::size_t wires = 0;
  for (auto _ : state) wires = raabe(slot.usable_area, r, silent).wires.size();
  count(state, wires);
}
void stator_orthocyclic(benchmark::State& state) {
  const Slot slot = make_slot(StatorSlot{});
  const double r = radius_for(slot, static_cast<double>(state.range(0)));
  std::size_t wires = 0;
  for (auto _ : state) wires = orthocyclic(slot.usable_area, r, slot.tension_point, 0, silent).wires.size();
  count(state, wires);
}
void stator_producible(benchmark::State& state) {
  const Slot slot = make_slot(StatorSlot{});
  const double r = radius_for(slot, static_cast<double>(state.range(0)));
  const Layout layout = needle(slot, r, StatorHeads{}, silent)[0];
  std::size_t held = 0;
  for (auto _ : state) {
    const Producible p = producible(slot.usable_area, r, layout, slot.tension_point, {}, silent);
    held = p.first ? p.first->laid : layout.wires.size();
  }
  state.counters["held"] = static_cast<double>(held);
  count(state, layout.wires.size());
}
void rotor_needle(benchmark::State& state) {
  const Slot slot = make_slot(RotorSlot{});
  std::size_t wires = 0;
  for (auto _ : state) wires = needle(slot, 0.6085, RotorHeads{}, silent)[0].wires.size();
  count(state, wires);
}

#define SIZES RangeMultiplier(2)->Range(32, 2048)->Complexity(benchmark::oAuto)->Unit(benchmark::kMillisecond)
BENCHMARK(stator_needle)->SIZES;
BENCHMARK(stator_raabe)->SIZES;
BENCHMARK(stator_orthocyclic)->SIZES;
BENCHMARK(stator_producible)
    ->RangeMultiplier(2)
    ->Range(32, 256)
    ->Complexity(benchmark::oAuto)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(rotor_needle)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk::winding
