/// What a needle's path with its `optimised` feed takes per turn, on the example parts and machines: the time of the
/// whole plan, and of its feed alone (`feed_per_turn`, s of processor time): the axes along the path, the convex
/// planner, the proven bound, the verifier, and the check of every setpoint.
#include <benchmark/benchmark.h>

#include <ctime>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/progress.hpp"
#include "tests/core/plan/winding/winding_requests.hpp"

namespace bahnwerk {
namespace {

/// Processor time by stages, as they are reported: a stage's own reports are some milliseconds apart.
class StageTimes final : public ProgressSink {
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

/// The coil repeated around the part, each in the next slot.
WindingRequest repeated(WindingRequest request, int coils, std::size_t machine) {
  const winding::Coil first = request.coils.front();
  for (int i = 1; i < coils; ++i) request.coils.push_back({first.first + i, first.span});
  request.configurations = test::winders()[machine].configurations;
  return request;
}
WindingRequest stator(int coils, std::size_t machine) { return repeated(stator_request(40), coils, machine); }
WindingRequest rotor(int coils, std::size_t machine) { return repeated(rotor_request(34), coils, machine); }

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

/// One coil, two, and about 200 turns.
template <int most>
void up_to(benchmark::internal::Benchmark* bench) {
  bench->Arg(1)->Arg(2)->Arg(most)->Complexity()->Unit(benchmark::kSecond);
}
BENCHMARK_CAPTURE(winding_feed, stator_robot, stator, 0)->Apply(up_to<5>);
BENCHMARK_CAPTURE(winding_feed, stator_vertical, stator, 1)->Apply(up_to<5>);
BENCHMARK_CAPTURE(winding_feed, rotor_horizontal, rotor, 2)->Apply(up_to<6>);

}  // namespace
}  // namespace bahnwerk
