#include "core/cam/optimal/free_angles.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk::cam {
namespace {

constexpr int most_steps = 30;
constexpr int most_halvings = 4;        // each halving halves the distance to the middle of the ranges
constexpr double coarsest_gap = 1e-4;   // gap relative to J, for programs before the last one
constexpr double least_section = 1e-3;  // fraction of the mean section by which angles are kept apart

class AngleSearch {
 public:
  AngleSearch(const LawTask& task, const LawBasis& basis, Progress progress)
      : task_(task), basis_(basis), progress_(progress) {}

  SplineResult at(const std::vector<double>& times, double gap, const std::vector<LawSample>* samples) {
    ++programs;
    SplineOptions options;
    options.gap = gap;
    return SplineProgram(task_, basis_, times).solve(options, progress_, samples);
  }

  /// Descends from one start.
  SplineResult descend(std::vector<double> times, double least_gap) {
    double gap = coarsest_gap;  // a small part of what the last step promised
    SplineResult now = at(times, gap, nullptr);
    double share = 1;  // fraction of the largest allowed radius that a step takes
    for (int step = 0; step < most_steps && share > 1e-5; ++step) {
      if (!usable(now)) {  // the times move towards the middle of the ranges, where a law is likelier
        const std::vector<double> middle = task_.middle();
        if (times == middle || step == most_halvings) break;
        for (std::size_t i = 0; i < times.size(); ++i) times[i] += 0.5 * (middle[i] - times[i]);
        now = at(times, gap, nullptr);
        continue;
      }
      JointReference reference{now.coefficients, radii(times, share)};
      ++programs;
      const JointStep next = SplineProgram(task_, basis_, times, &reference).joint_step(now.samples, progress_);
      const double predicted = now.objective - next.objective;
      if (next.converged && predicted <= 3e-7 * now.objective) break;
      if (next.converged) gap = std::clamp(0.05 * predicted / now.objective, least_gap, gap);
      SplineResult there;
      if (next.converged) there = at(next.times, gap, &now.samples);
      const double gained = usable(there) ? now.objective - there.objective : -1;
      if (next.converged && gained > 0) {
        if (gained > 0.7 * predicted) share = std::min(1.0, 2.5 * share);
        if (gained < 0.2 * predicted) share *= 0.4;
        times = next.times;
        now = std::move(there);
      } else {
        share *= 0.3;
      }
    }
    return now;
  }

  /// The law at the angles that were found, to the gap of fixed angles.
  void finish(FreeAngles& result) {
    if (usable(result.spline)) {
      const std::vector<double> times(result.spline.breaks.begin(),
                                      result.spline.breaks.begin() + static_cast<std::ptrdiff_t>(task_.points()));
      SplineResult fine = at(times, SplineOptions{}.gap, &result.spline.samples);
      if (usable(fine) && fine.objective <= result.spline.objective) result.spline = std::move(fine);
    }
    result.programs = programs;
  }

  static bool usable(const SplineResult& result) { return result.feasible && result.violation < 1e-6; }

  int programs = 0;

 private:
  std::vector<double> radii(const std::vector<double>& times, double share) const {
    const std::vector<double> breaks = task_.breaks(times);
    std::vector<double> result(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (task_.at[i].fixed()) continue;
      double room = breaks.back() - breaks.front();
      if (i > 0) room = std::min(room, breaks[i] - breaks[i - 1]);
      if (i + 1 < breaks.size()) room = std::min(room, breaks[i + 1] - breaks[i]);
      if (i == 0 && task_.periodic) room = std::min(room, breaks.back() - breaks[breaks.size() - 2]);
      result[i] = 0.25 * share * room;
    }
    return result;
  }

  const LawTask& task_;
  const LawBasis& basis_;
  Progress progress_;
};

/// Moves times into their ranges and makes them ascend.
void order(const LawTask& task, std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0) times[i] = std::max(times[i], times[i - 1] + least_section);
    times[i] = std::clamp(times[i], task.at[i].min, task.at[i].max);
  }
  for (std::size_t i = times.size() - 1; i-- > 0;)
    times[i] = std::clamp(std::min(times[i], times[i + 1] - least_section), task.at[i].min, task.at[i].max);
}

}  // namespace

FreeAngles optimise_angles(const LawTask& task, const LawBasis& basis, std::uint64_t seed, Progress progress) {
  AngleSearch search(task, basis, progress);
  Random random(seed);
  constexpr int starts = 4;
  FreeAngles result;
  for (int start = 0; start < starts; ++start) {
    std::vector<double> times = task.middle();
    if (start > 0)
      for (std::size_t i = 0; i < times.size(); ++i)
        if (!task.at[i].fixed()) times[i] = random.uniform(task.at[i].min, task.at[i].max);
    order(task, times);
    SplineResult found = search.descend(std::move(times), 1e-6);
    result.start_results.push_back(found.objective);
    const bool usable = AngleSearch::usable(found), known = AngleSearch::usable(result.spline);
    // Two starts that end in the same law leave little to look for.
    const bool same = usable && known && std::abs(found.objective - result.spline.objective) < 1e-5 * found.objective;
    if (start == 0 || (usable && (!known || found.objective < result.spline.objective)))
      result.spline = std::move(found);
    if (same) break;
  }
  search.finish(result);
  return result;
}

FreeAngles refine_angles(const LawTask& task, const LawBasis& basis, const std::vector<double>& times,
                         Progress progress) {
  AngleSearch search(task, basis, progress);
  FreeAngles result;
  result.spline = search.descend(times, 1e-6);
  result.start_results.push_back(result.spline.objective);
  search.finish(result);
  return result;
}

}  // namespace bahnwerk::cam
