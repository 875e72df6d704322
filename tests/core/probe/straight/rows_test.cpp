#include "core/probe/straight/rows.hpp"

#include <algorithm>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/spline/spline.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk::probe {
namespace {

/// Rows by trying every end: the last one behind which no further point lies on the line, in order.
std::vector<std::size_t> by_trial(const ProbeProblem& p) {
  const std::size_t last = p.points.size() - 1;
  std::vector<std::size_t> end(p.points.size(), last);
  for (std::size_t a = 0; a < last;) {
    std::size_t b = a + 1;
    for (; b < last; ++b) {
      const Vec u = p.points[b + 1] - p.points[b], v = p.points[b] - p.points[b - 1];
      if (norm(cross(u, v)) > 1e-9 || dot(u, v) <= 0) break;
    }
    for (std::size_t i = a; i < b; ++i) end[i] = b;
    a = b;
  }
  return end;
}

TEST(Rows, RowsEndAtCornersAndReversals) {
  Random random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec> points{{0, 0}};
    const Vec ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    std::size_t way = 0;
    for (int i = 0; i < 30; ++i) {
      if (random.chance(0.3)) way = random.below(4);
      points.push_back(points.back() + static_cast<double>(1 + random.below(3)) * ways[way]);
    }
    const ProbeProblem p = probe_cases::problem(points, 0.01);
    EXPECT_EQ(straight_rows(p), by_trial(p)) << round;
  }
}

/// A row along x with deviations of up to `noise` from it.
std::vector<Vec> noisy_row(std::size_t n, double noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec> points{{0, 0}};
  for (std::size_t i = 1; i + 1 < n; ++i)
    points.push_back({10.0 * static_cast<double>(i) / static_cast<double>(n - 1), noise * random.uniform(-1, 1)});
  points.push_back({10, 0});
  return points;
}

ProbeProblem noisy(std::vector<Vec> points, double point_tolerance) {
  ProbeProblem p = probe_cases::problem(std::move(points), 0.05);
  p.point_tolerance = point_tolerance;
  merge_points(p);
  return p;
}

TEST(Rows, PointsWithinPointToleranceOfAStraightArePassedByIt) {
  Progress silent;
  for (const std::size_t n : {5u, 51u, 400u}) {
    const ProbeProblem p = noisy(noisy_row(n, 0.00395, n), 0.004);
    for (const ProbeMotion& plan : {plan_arcs(p, silent), plan_spline(p, silent)}) {
      EXPECT_NEAR(plan.duration(), 10.0 / 20 + 0.17, 1e-9) << n;
      probe_cases::expect_right(p, plan);
    }
  }
}

TEST(Rows, PointsThatAreOneLeaveLessOfTheTolerance) {
  // The third given point counts as the second one, 0.9 µm from it: the straight between the ends is 3.3 µm from that
  // one, within the tolerance, and 4.2 µm from the third.
  const ProbeProblem p = noisy({{0, 0}, {5, 0.0033}, {5, 0.0042}, {10, 0}}, 0.004);
  ASSERT_EQ(p.points.size(), 3u);
  Progress silent;
  for (const ProbeMotion& plan : {plan_arcs(p, silent), plan_spline(p, silent)}) probe_cases::expect_right(p, plan);
}

TEST(Rows, RowsOfReversedPointsTakeTheSameTime) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<Vec> points = noisy_row(seed % 2 ? 12 : 90, 0.006, seed);
    const double forwards = stops_duration(noisy(points, 0.004));
    std::reverse(points.begin(), points.end());
    EXPECT_NEAR(stops_duration(noisy(points, 0.004)), forwards, 1e-12 * forwards) << seed;
  }
}

}  // namespace
}  // namespace bahnwerk::probe
