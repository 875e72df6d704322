/// Time per turn of a needle path, from the layout in all four regions to the links that are smoothest by (4.60): one
/// coil of a thin wire (0.5 mm with its enamel), of which a slot of the examples takes 200 turns and more; and the
/// largest coil of the example rotor. And of the clearance along that path.
#include <benchmark/benchmark.h>

#include "core/base/progress.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/needle/clearance.hpp"
#include "core/winding/needle/part_obstacles.hpp"
#include "core/winding/needle/support_points.hpp"
#include "core/winding/path/needle_path.hpp"

namespace bahnwerk::winding {
namespace {

Progress silent;

void count(benchmark::State& state, std::size_t turns) {
  state.counters["turns"] = static_cast<double>(turns);
  state.counters["time_per_turn"] = benchmark::Counter(
      static_cast<double>(turns), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(turns));
}

/// All turns that the slot takes, or as many as `most`.
std::vector<Turn> turns(const LayingRegions& regions, const Slot& slot, double radius, std::size_t most) {
  const NeedleLayout layout = needle(regions, radius, slot.tension_point, silent);
  return turns_of({regions}, layout, std::min(most, layout[0].wires.size()), radius);
}

/// Tips are held clear of the part, as kind winding does.
NeedleModel held_clear() {
  NeedleModel model;
  model.shape = NeedleShape{};
  model.shape->width = 1.6;
  return model;
}

/// A coil of a stator.
struct StatorCoil {
  StatorPart part;
  Coil coil = coil_between(part, 0, 5);
  Slot slot = checked_slot(part);
  NeedleModel model = held_clear();
  StatorCoil() { model.pivot_limit = 0.2; }
  NeedlePath path(std::size_t most, std::size_t& made) const {
    const auto list = turns(coil_regions(part, slot, coil), slot, 0.25, most);
    made = list.size();
    return *needle_path(*support_points(part, {coil}, list, model, silent), true, {}, silent);
  }
};

void stator_path(benchmark::State& state) {
  const StatorCoil stator;
  std::size_t made = 0;
  for (auto _ : state) benchmark::DoNotOptimize(stator.path(static_cast<std::size_t>(state.range(0)), made));
  count(state, made);
}

void stator_clearance(benchmark::State& state) {
  const StatorCoil stator;
  std::size_t made = 0;
  const std::vector<BezierPiece> pieces = stator.path(static_cast<std::size_t>(state.range(0)), made).curves();
  const PartObstacles obstacles = part_obstacles(stator.part, stator.slot, {}, {stator.coil});
  for (auto _ : state)
    benchmark::DoNotOptimize(clearance(pieces, *stator.model.shape, obstacles.list(), 0.001, silent));
  count(state, made);
}

void rotor(benchmark::State& state, double radius, std::size_t most) {
  const RotorPart part;
  const Coil coil = coil_between(part, 0, 1);
  const Slot slot = checked_slot(part);
  const NeedleModel model = held_clear();
  std::size_t made = 0;
  for (auto _ : state) {
    const auto list = turns(coil_regions(part, slot, coil), slot, radius, most);
    made = list.size();
    benchmark::DoNotOptimize(*needle_path(*support_points(part, list, model, silent), false, {}, silent));
  }
  count(state, made);
}
void rotor_path(benchmark::State& state) { rotor(state, 0.25, static_cast<std::size_t>(state.range(0))); }
void example_rotor(benchmark::State& state) { rotor(state, 1.217 / 2, 1000); }  // wire of 1.12 mm, grade 2

BENCHMARK(stator_path)->RangeMultiplier(2)->Range(25, 200)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(stator_clearance)->RangeMultiplier(2)->Range(25, 200)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(rotor_path)->RangeMultiplier(2)->Range(25, 200)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(example_rotor)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk::winding
