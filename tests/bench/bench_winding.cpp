/// Time of what every layout stands on: distances to a slot, the verifier's look at a layout; of a whole sweep; and of
/// the check of a plan's rows that needle and wire are in the coil's slots.
#include <benchmark/benchmark.h>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/plan/fill_plan.hpp"
#include "core/plan/winding/coil_passes.hpp"
#include "core/verify/layout_verifier.hpp"
#include "tests/core/plan/winding/winding_requests.hpp"

namespace bahnwerk {
namespace {

using winding::Algorithm;

/// One distance to the usable area's boundary; both slots have some 14 edges.
void distance(benchmark::State& state, const winding::Slot& slot) {
  Random random(1);
  std::vector<Point> points;
  const auto& box = slot.usable_area.box();
  for (int k = 0; k < 4096; ++k)
    points.push_back({random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y)});
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(slot.usable_area.distance(points[i++ % points.size()]));
}

/// Wires on a lattice, verified; time per wire grows with their number: every pair is looked at.
void verifying(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  const double side = std::sqrt(static_cast<double>(n));
  const winding::Slot slot = make_slot(winding::PolygonSlot{{{0, 0}, {side, 0}, {side, side}, {0, side}}, 0, 0});
  std::vector<Point> wires;
  for (double y = 0.5; y < side; ++y)
    for (double x = 0.5; x < side; ++x) wires.push_back({x, y});
  Progress silent;
  const LayoutToVerify layout{"lattice", 0.9, 0.5, 0, wires, n};
  for (auto _ : state) benchmark::DoNotOptimize(verify_layouts(slot.usable_area, std::span(&layout, 1), silent));
  state.SetComplexityN(state.range(0));
}

/// The example stator slot, 0.50 to 1.60 mm, five layouts each, verdicts and verifier included.
void sweep(benchmark::State& state, winding::Series series) {
  FillRequest request;
  request.slot = make_slot(winding::StatorSlot{});
  request.wires = winding::standard_wires(2, 0.5, 1.6, series);
  request.algorithms = {Algorithm::orthocyclic_base, Algorithm::orthocyclic_flank, Algorithm::raabe,
                        Algorithm::potential, Algorithm::needle};
  request.tie_in = request.slot.tension_point;
  request.heads = winding::StatorHeads{};
  Progress silent;
  for (auto _ : state) benchmark::DoNotOptimize(plan_fill(request, silent));
}

/// The rows of four turns on the example stator, read beforehand.
void coil_slots(benchmark::State& state) {
  const WindingRequest asked = stator_request(4);
  Progress silent;
  const WindingPlan plan = plan_winding(asked, silent);
  const SetpointSource& setpoints = *plan.motion.setpoints;
  const std::size_t count = setpoints.count(), width = setpoints.columns().size();
  std::vector<double> rows(count * width);
  setpoints.read(0, count, rows.data());
  for (auto _ : state) {
    const std::unique_ptr<RowCheck> check = coil_slot_row_check(coil_passes(asked, plan, setpoints));
    for (std::size_t k = 0; k < count; ++k) check->row(k, &rows[k * width]);
    benchmark::DoNotOptimize(check->checks());
  }
  state.counters["per_row"] = benchmark::Counter(
      static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(coil_slots)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(distance, stator, make_slot(winding::StatorSlot{}));
BENCHMARK_CAPTURE(distance, rotor, make_slot(winding::RotorSlot{}));
BENCHMARK(verifying)->RangeMultiplier(4)->Range(64, 4096)->Complexity();
BENCHMARK_CAPTURE(sweep, r20, winding::Series::r20)->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK_CAPTURE(sweep, r40, winding::Series::r40)->Unit(benchmark::kSecond)->Iterations(1);

}  // namespace
}  // namespace bahnwerk
