/// Overhead per evaluation, and slsqp on convex quadratics whose minimum is known. CPU times: an evaluation of these
/// problems is next to nothing, so the time per evaluation is NLopt's subproblem.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>

#include "core/base/progress.hpp"
#include "tests/core/numeric/optimise/problems.hpp"

namespace bahnwerk {
namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The longest time between two calls.
struct LongestGap final : ProgressSink {
  void report(std::string_view, double, std::string_view) override {
    const double now = cpu_seconds();
    longest = std::max(longest, now - last);
    last = now;
  }
  double last = cpu_seconds(), longest = 0;
};

void solve(benchmark::State& state, const KnownProblem& known, OptimisationMethod method) {
  OptimisationOptions options;
  options.method = method;
  options.max_evaluations = 2000;
  std::size_t evaluations = 0;
  double longest = 0;
  for (auto _ : state) {
    LongestGap gap;
    const OptimisationResult found = minimise(known.problem, known.start, options, gap);
    evaluations += found.evaluations;
    longest = std::max(longest, gap.longest);
  }
  using benchmark::Counter;
  const auto all = static_cast<double>(evaluations);
  state.counters["evaluations"] = Counter(all, Counter::kAvgIterations);
  state.counters["per_evaluation"] = Counter(all, Counter::kIsRate | Counter::kInvert);
  state.counters["longest_gap_s"] = longest;
}

BENCHMARK_CAPTURE(solve, rosenbrock_slsqp, rosenbrock(), OptimisationMethod::slsqp)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, rosenbrock_cobyla, rosenbrock(), OptimisationMethod::cobyla)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, hs100_slsqp, hs100(), OptimisationMethod::slsqp)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, quadratic_100, banded_quadratic(100), OptimisationMethod::slsqp)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, quadratic_200, banded_quadratic(200), OptimisationMethod::slsqp)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, quadratic_400, banded_quadratic(400), OptimisationMethod::slsqp)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace bahnwerk
