// What has to hold between problems: time is only a scale, reversed points are the same path, rests are never slower
// where more is allowed, and optimal hardly.
#include <algorithm>

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/optimal/optimal.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

double arcs(const ProbeProblem& p) {
  Progress silent;
  return plan_arcs(p, silent).duration();
}
double spline(const ProbeProblem& p) {
  Progress silent;
  return plan_spline(p, silent).duration();
}
double optimal(const ProbeProblem& p) {
  Progress silent;
  return plan_optimal(p, silent).duration();
}

/// The same problem with time k times as slow.
ProbeProblem scaled(ProbeProblem p, double k) {
  p.speed /= k;
  for (AxisLimits& axis : p.machine.axes)
    axis.acceleration /= k * k, axis.jerk /= k * k * k, axis.snap /= k * k * k * k;
  return p;
}

TEST(ProbeMonotone, TimeIsOnlyAScaleOfArcsAndSpline) {
  for (int i = 0; i < testing::cases(5); ++i) {
    const RandomSet set(static_cast<std::uint64_t>(1000 + i));
    const double a = arcs(set.problem), b = spline(set.problem);
    for (const double k : {4.0, 0.3}) {
      EXPECT_NEAR(arcs(scaled(set.problem, k)), k * a, 1e-12 * k * a) << set.words;
      EXPECT_NEAR(spline(scaled(set.problem, k)), k * b, 1e-12 * k * b) << set.words;
    }
  }
}

TEST(ProbeMonotone, ArcsTakeTheSameTimeThroughReversedPoints) {
  for (int i = 0; i < testing::cases(12); ++i) {
    ProbeProblem p = RandomSet(static_cast<std::uint64_t>(2000 + i)).problem;
    const double forwards = arcs(p);
    std::reverse(p.given.begin(), p.given.end());
    merge_points(p);
    EXPECT_NEAR(arcs(p), forwards, 1e-9 * forwards) << i;
  }
}

TEST(ProbeMonotone, TimeIsOnlyAScaleOfOptimal) {
  const std::vector<ProbeProblem> problems{
      problem({{0, 0}, {5, 0}, {5, 5}}, 0.05), problem({{3, 1}, {9, 1}, {4, 1}}, 0),
      problem({{0, 0, 0}, {1.2, 0.3, 0.1}, {2, 1.4, 0.9}, {0.9, 2, 2.2}}, 0.1, 3, 7, 90, 2500, 70000)};
  for (const ProbeProblem& p : problems) {
    const double duration = optimal(p);
    for (const double k : {0.37, 1.0 / 3, 2.0, 10.0})
      EXPECT_NEAR(optimal(scaled(p, k)), k * duration, 1e-12 * k * duration) << k << " " << p.points.size();
  }
}

/// The problem with each of its bounds 1.2 times as large, one at a time.
std::vector<ProbeProblem> looser(const ProbeProblem& p) {
  std::vector<ProbeProblem> list(5, p);
  list[0].speed *= 1.2;
  list[1].tolerance *= 1.2;
  for (AxisLimits& axis : list[2].machine.axes) axis.acceleration *= 1.2;
  for (AxisLimits& axis : list[3].machine.axes) axis.jerk *= 1.2;
  for (AxisLimits& axis : list[4].machine.axes) axis.snap *= 1.2;
  return list;
}

TEST(ProbeMonotone, RestsAreNeverSlowerWhereMoreIsAllowed) {
  for (int i = 0; i < testing::cases(30); ++i) {
    const RandomSet set(static_cast<std::uint64_t>(3000 + i));
    const double before = stops_duration(set.problem);
    for (const ProbeProblem& p : looser(set.problem)) EXPECT_LE(stops_duration(p), before * (1 + 1e-12)) << set.words;
  }
}

TEST(ProbeMonotone, OptimalIsSlowerByATenthOfAPerCentAtMostWhereMoreIsAllowedOrPointsAreReversed) {
  const std::vector<ProbeProblem> problems{
      problem({{0, 0}, {5, 0}, {5, 5}, {9, 7}}, 0.05),
      problem({{0, 0, 0}, {12, 0, 2}, {20, 9, 2}, {11, 16, 5}}, 0.2, 3, 20, 250, 5000, 250000),
      problem(circle(20, 6), 0.1)};
  for (const ProbeProblem& p : problems) {
    const double before = optimal(p);
    for (const ProbeProblem& more : looser(p)) EXPECT_LE(optimal(more), 1.001 * before) << p.points.size();
    ProbeProblem reversed = p;
    std::reverse(reversed.given.begin(), reversed.given.end());
    merge_points(reversed);
    EXPECT_NEAR(optimal(reversed), before, 1e-3 * before) << p.points.size();
  }
}

}  // namespace
}  // namespace bahnwerk
