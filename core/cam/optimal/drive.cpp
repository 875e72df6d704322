#include "core/cam/optimal/drive.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/degree_choice.hpp"
#include "core/cam/optimal/free_angles.hpp"
#include "core/cam/optimal/law_faults.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double wanted = 1e-7;  // share of the duration that may be left between long enough and too short
constexpr int most_durations = 60;

/// Returns whether a stretched law is one, too: all derivatives that are asked for are 0 or ranges that contain it.
bool stretches(const MotionLawProblem& problem) {
  const auto contains_zero = [](const Range& range) { return range.min <= 0 && range.max >= 0; };
  for (const MotionPoint& point : problem.points) {
    for (int r = 1; r < static_cast<int>(point.values.size()); ++r)
      if (!contains_zero(point.value(r))) return false;
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (!contains_zero(point.section[r])) return false;
  }
  return problem.vibration.empty();
}

LawTask task_of(const MotionLawProblem& problem, double duration) {
  MotionLawProblem timed = problem;
  timed.cycle_duration = duration;
  LawTask task = make_law_task(timed);
  const double limit[limited_orders] = {0, problem.drive->velocity, problem.drive->acceleration, problem.drive->jerk};
  task.largest_peak = true;
  for (std::size_t r = 1; r < limited_orders; ++r)
    task.weight[r] = std::isfinite(limit[r]) ? 1 / (limit[r] * task.to_task(static_cast<int>(r))) : 0;
  return task;
}

}  // namespace

ShortestCycle find_shortest_cycle(const MotionLawProblem& problem, Progress& progress) {
  ShortestCycle result;
  result.monotone = stretches(problem);
  const double none = std::numeric_limits<double>::infinity();
  if (!problem.drive ||
      (problem.drive->velocity == none && problem.drive->acceleration == none && problem.drive->jerk == none))
    throw InvalidInput(
        {InputFault{{"drive"}, "a cycle without duration needs a limit of velocity, acceleration or jerk"}});
  LawTask task = task_of(problem, 1);
  result.degree = problem.degree ? *problem.degree : std::max(least_degree(task), 5);
  result.pieces = problem.degree ? problem.pieces : 8;
  const SectionBasis basis(result.degree, result.pieces);
  std::vector<double> times = task.middle();
  const auto solve = [&](double duration) {
    ++result.programs;
    task = task_of(problem, duration);
    return SplineProgram(task, basis, times).solve({}, progress);
  };
  const auto usable = [](const SplineResult& spline) { return spline.feasible && spline.violation <= 1e-8; };
  // A first duration from the peaks of some law.
  double duration = 1;
  SplineResult spline = solve(duration);
  if (task.free_angles() && usable(spline)) {
    const FreeAngles free = optimise_angles(task, basis, problem.seed, progress);
    result.programs += free.programs;
    if (!free.spline.breaks.empty())
      times.assign(free.spline.breaks.begin(), free.spline.breaks.begin() + static_cast<std::ptrdiff_t>(times.size()));
    spline = solve(duration);
  }
  double low = 0, high = none, slope = 2;  // M falls like T^−slope
  double last_duration = 0, last = 0;
  for (int i = 0; i < most_durations; ++i) {
    progress.report("shortest cycle", 0);
    if (!usable(spline)) {
      if (result.monotone && high == none && i == 0) {
        explain_infeasible(task, basis, times, progress);
        throw InvalidInput({InputFault{{"degree"}, "no law of this degree keeps all values, ranges and limits"}});
      }
      low = std::max(low, duration);
      duration = high < none ? std::sqrt(low * high) : 2 * duration;
    } else {
      const double m = spline.objective;
      if (m <= 1) {
        high = duration;
        result.spline = spline;
        result.duration = duration;
      } else {
        low = std::max(low, duration);
        if (spline.lower > 1) result.too_short = std::max(result.too_short, duration);
      }
      if (high < none && low > 0 && high <= low * (1 + wanted)) break;
      if (last > 0 && duration != last_duration) {
        const double now = -std::log(m / last) / std::log(duration / last_duration);
        if (std::isfinite(now)) slope = std::clamp(now, 0.9, 3.1);
      }
      last = m;
      last_duration = duration;
      // A little to the side on which nothing is known yet.
      const double aside = m <= 1 ? 1 - 0.4 * wanted : 1 + 0.4 * wanted;
      duration *= std::pow(m, 1 / slope) * aside;
      if (!(duration > low && duration < high))
        duration = high < none ? (low > 0 ? std::sqrt(low * high) : high / 2) : 2 * low;
    }
    spline = solve(duration);
  }
  if (result.duration == 0) {
    explain_infeasible(task, basis, times, progress);
    throw InvalidInput({InputFault{{"drive"}, "no duration was found in which a law keeps these limits"}});
  }
  return result;
}

}  // namespace bahnwerk::cam
