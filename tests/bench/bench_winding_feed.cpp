/// What a needle's path with its `optimised` feed takes per turn, on the example parts and machines: the time of the
/// whole plan, and of its feed alone (`feed_per_turn`, s of processor time): the axes along the path, the convex
/// planner, the proven bound, the verifier, and the check of every setpoint.
#include <benchmark/benchmark.h>

#include <ctime>
#include <map>
#include <string>
#include <string_view>

#include "core/plan/winding/winding_plan.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

/// Processor time by stages, as they are reported: a stage's own reports are some milliseconds apart.
class StageTimes final : public Progress {
 public:
  void report(std::string_view stage, double, std::string_view) override {
    const std::clock_t now = std::clock();
    times_[std::string(stage)] += static_cast<double>(now - last_) / CLOCKS_PER_SEC;
    last_ = now;
  }
  double feed() const {
    double sum = 0;
    for (const char* stage : {"machine", "planning", "bound", "verify", "verify jerk", "verify setpoints"})
      if (const auto found = times_.find(stage); found != times_.end()) sum += found->second;
    return sum;
  }

 private:
  std::clock_t last_ = std::clock();
  std::map<std::string, double> times_;
};

WindingRequest request(std::size_t turns, std::size_t machine) {
  WindingRequest r;
  r.wire = *winding::standard_wire(0.9, 2);
  r.turns = turns;
  r.least_clearance = -100;  // whether the needle passes is not asked here
  r.configurations = test::winders()[machine].configurations;
  return r;
}

WindingRequest stator(int coils, std::size_t machine) {
  WindingRequest r = request(40, machine);
  const winding::StatorPart part;
  r.part = part;
  r.model.pivot_limit = 0.2;
  for (int i = 0; i < coils; ++i) r.coils.push_back(winding::coil_between(part, i, i + 5));
  return r;
}

WindingRequest rotor(int coils, std::size_t machine) {
  WindingRequest r = request(34, machine);
  const winding::RotorPart part;
  r.part = part;
  for (int i = 0; i < coils; ++i) r.coils.push_back(winding::coil_between(part, i, i + 1));
  return r;
}

void winding_feed(benchmark::State& state, WindingRequest (*make)(int, std::size_t), std::size_t machine) {
  const WindingRequest asked = make(static_cast<int>(state.range(0)), machine);
  const double turns = static_cast<double>(asked.turns * asked.coils.size());
  double feed = 0, gap = 0;
  for (auto _ : state) {
    StageTimes times;
    const WindingPlan plan = plan_winding(asked, times);
    if (!plan.motion.verification.passed) state.SkipWithError("not verified");
    feed += times.feed(), gap = plan.motion.bound.gap;
  }
  state.counters["turns"] = turns;
  state.counters["gap"] = gap;
  state.counters["feed_per_turn"] = feed / turns / static_cast<double>(state.iterations());
  state.counters["time_per_turn"] =
      benchmark::Counter(turns, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(turns));
}

BENCHMARK_CAPTURE(winding_feed, stator_robot, stator, 0)
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->Complexity()
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(winding_feed, stator_vertical, stator, 1)
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->Complexity()
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(winding_feed, rotor_horizontal, rotor, 2)
    ->Arg(1)
    ->Arg(2)
    ->Arg(6)
    ->Complexity()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace bahnwerk
