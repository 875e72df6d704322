/// Optimal motion laws: fixed angles over sections and degree, 50 points, free angles, and the bound over all laws.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/cam/optimal/free_angles.hpp"
#include "core/cam/optimal/relaxation/law_bound.hpp"
#include "core/cam/optimal/relaxation/relaxation.hpp"

namespace bahnwerk::cam {
namespace {

/// A cam of `points` points over 360 deg in 1 s: heights that rise and fall, every second one a range.
MotionLawProblem cam(std::size_t points, bool free_angles) {
  MotionLawProblem problem;
  problem.method = LawMethod::optimal;
  problem.cycle_duration = 1;
  problem.periodic = true;
  problem.objective.weight = {0, 1, 0.1, 0.01};
  for (std::size_t i = 0; i < points; ++i) {
    MotionPoint point;
    const double at = 360 * (static_cast<double>(i) + (i % 3 == 1 ? 0.2 : 0)) / static_cast<double>(points);
    const double room = free_angles && i > 0 ? 0.25 * 360 / static_cast<double>(points) : 0;
    point.at = {at - room, at + room};
    const double height = 20 - 20 * std::cos(at * 3.14159265358979 / 180) + (i % 4 == 2 ? 3 : 0);
    point.values = {i % 2 ? Range{height - 0.5, height + 0.5} : Range{height, height}};
    point.continuity = 3;
    problem.points.push_back(point);
  }
  return problem;
}

void fixed_angles(benchmark::State& state) {
  Progress progress;
  const LawTask task = make_law_task(cam(static_cast<std::size_t>(state.range(0)), false));
  int rounds = 0, iterations = 0;
  for (auto _ : state) {
    const LawBasis basis(task, static_cast<int>(state.range(1)), 1);
    const SplineResult result = SplineProgram(task, basis, task.middle()).solve({}, progress);
    benchmark::DoNotOptimize(result.objective);
    rounds = result.rounds, iterations = result.iterations;
  }
  state.counters["rounds"] = rounds;
  state.counters["iterations"] = iterations;
}
BENCHMARK(fixed_angles)
    ->Args({5, 7})
    ->Args({5, 9})
    ->Args({10, 7})
    ->Args({20, 7})
    ->Args({50, 7})
    ->Unit(benchmark::kMillisecond);

void all_laws(benchmark::State& state) {
  Progress progress;
  const LawTask task = make_law_task(cam(static_cast<std::size_t>(state.range(0)), false));
  const LawBasis basis(task, 7, 1);
  const KnownLaw law(task, basis, SplineProgram(task, basis, task.middle()).solve({}, progress));
  for (auto _ : state) benchmark::DoNotOptimize(relaxation_bound(task, task.at, law, {}, progress));
}
BENCHMARK(all_laws)->Arg(5)->Arg(50)->Unit(benchmark::kMillisecond);

void free_angles(benchmark::State& state) {
  Progress progress;
  const LawTask task = make_law_task(cam(static_cast<std::size_t>(state.range(0)) + 1, true));
  const LawBasis basis(task, 7, 1);
  for (auto _ : state) benchmark::DoNotOptimize(optimise_angles(task, basis, 1, progress).spline.objective);
}
BENCHMARK(free_angles)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace bahnwerk::cam
