#include "core/probe/optimal/optimal.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/probe/figures.hpp"
#include "core/probe/straight/stops.hpp"
#include "core/verify/probe/probe_bound.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/probe/probe_cases.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;
using testing::cases;

ProbeMotion stops(const ProbeProblem& problem) {
  Progress silent;
  return plan_stops(problem, silent);
}
ProbeMotion optimal(const ProbeProblem& problem) {
  Progress silent;
  const ProbeMotion plan = plan_optimal(problem, silent);
  expect_right(problem, plan);
  return plan;
}
double bound(const ProbeProblem& problem) {
  Progress silent;
  return probe_bound(problem, silent).value;
}

TEST(Optimal, ACornerIsPassedWithinAPerCentOfTheBound) {
  const ProbeProblem p = problem({{1, 2}, {1, 8}, {7, 8}}, 0.06);
  const double planned = optimal(p).duration(), least = bound(p);
  EXPECT_LE(least, planned);
  EXPECT_LT(planned, 1.01 * least);
  EXPECT_LT(planned, 0.95 * stops(p).duration());
}

TEST(Optimal, AShortMoveIsQuickerThanFifteenPhases) {
  // Snap alone limits it: (384 d/S)^¼ is the least time of all, (512 d/S)^¼ that of fifteen phases.
  const ProbeProblem p = problem({{0, 0}, {0, 0.03}}, 0.05);
  const double planned = optimal(p).duration();
  EXPECT_GE(planned, std::pow(384 * 0.03 / 200000, 0.25));
  EXPECT_LT(planned, 1.002 * std::pow(384 * 0.03 / 200000, 0.25));
}

TEST(Optimal, MinutesAtFullSpeedEndOnTheLastPoint) {
  // Places are carried from piece to piece; rounding of 250 s at 20 mm/s adds up to more than the verifier grants.
  optimal(problem({{0, 0}, {3, 0.2}, {6, 0.8}, {9, 0.9}, {12, -5000}, {15, 0}}, 0.2));
}

TEST(Optimal, TwoPointsTakeNoLongerThanTheProfile) {
  const ProbeProblem p = problem({{0, 0, 0}, {0, 60, 0}}, 0.05, 3);
  EXPECT_LE(optimal(p).duration(), 3.17 + 1e-9);
  EXPECT_GT(optimal(p).duration(), 0.999 * 3.17);
}

TEST(Optimal, WithoutTubeCornersAreRestsAndReversalsAreNot) {
  const double corner = optimal(problem({{0, 0}, {6, 0}, {6, 6}}, 0)).duration();
  EXPECT_NEAR(corner, 2 * (6.0 / 20 + 0.17), 1e-3);
  const ProbeProblem back = problem({{0, 0}, {30, 40}, {12, 16}}, 0);
  EXPECT_LT(optimal(back).duration(), stops(back).duration() - 0.02);
}

TEST(Optimal, DensePointsOnACircleArePassedAtSpeed) {
  for (std::size_t n : {40u, 300u}) {
    const ProbeProblem p = problem(circle(n, 6), 0.05);
    const double planned = optimal(p).duration();
    EXPECT_LT(planned, 2 * M_PI * 6 / 20 + 0.21) << n;
    EXPECT_GE(planned, 12 * static_cast<double>(n) * std::sin(M_PI / static_cast<double>(n)) / 20) << n;
  }
}

TEST(Optimal, NoiseBelowThePointToleranceCostsNothing) {
  ProbeProblem p = problem(circle(40, 6), 0.05);
  Random random(11);
  for (Vec& v : p.given) v = v + Vec{2e-4 * (random.uniform() - 0.5), 2e-4 * (random.uniform() - 0.5), 0};
  p.point_tolerance = 3e-4;
  merge_points(p);
  EXPECT_LT(optimal(p).duration(), 2 * M_PI * 6 / 20 + 0.22);
}

/// n points of a quarter circle of 1 mm or of a straight of 10 mm, all but the ends moved by up to `noise` mm.
ProbeProblem dense(bool straight, int n, double noise, double point_tolerance) {
  ProbeProblem p;
  Random random(3);
  std::vector<Vec> points;
  for (int i = 0; i < n; ++i) {
    const double u = static_cast<double>(i) / (n - 1), angle = 2 * M_PI * random.uniform();
    const double e = i > 0 && i + 1 < n ? noise * random.uniform() : 0;
    const Vec at = straight ? Vec{10 * u, 0, 0} : Vec{std::cos(u * M_PI / 2), std::sin(u * M_PI / 2), 0};
    points.push_back(at + Vec{e * std::cos(angle), e * std::sin(angle), 0});
  }
  p = problem(points, 0.05);
  p.point_tolerance = point_tolerance;
  merge_points(p);
  return p;
}

TEST(Optimal, DensePointsOfAnArcCostNothingWithNoiseOrWithout) {
  const double sparse = optimal(dense(false, 33, 0, 1e-6)).duration();
  for (const int n : {101, 401, 3000})
    for (const double share : {0.0, 0.9})
      for (const double point_tolerance : {1e-6, 3e-4})
        EXPECT_LT(optimal(dense(false, n, share * point_tolerance, point_tolerance)).duration(), 1.01 * sparse)
            << n << " " << share << " " << point_tolerance;
}

TEST(Optimal, NoiseOfManySpacingsCostsNothingWhereItIsBelowThePointTolerance) {
  const double sparse = optimal(dense(false, 33, 0, 1e-6)).duration();
  for (const int n : {101, 401, 3000})
    EXPECT_LT(optimal(dense(false, n, 0.9 * 3e-3, 3e-3)).duration(), 1.01 * sparse) << n;
}

/// Points of a curve at random places along it, within `share` of `tolerance` of it.
ProbeProblem at_random_places(int n, double tolerance, double share, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> at{0, 1};
  while (at.size() < static_cast<std::size_t>(n)) at.push_back(random.uniform());
  std::sort(at.begin(), at.end());
  std::vector<Vec> points;
  for (double u : at) {
    const double angle = 2 * M_PI * random.uniform(), off = share * tolerance * random.uniform();
    points.push_back(
        {10 * u + off * std::cos(angle), 0.8 * std::sin(5 * u) + 0.3 * std::sin(11 * u) + off * std::sin(angle)});
  }
  ProbeProblem p = problem(std::move(points), 0.05);
  p.point_tolerance = tolerance;
  merge_points(p);
  return p;
}

TEST(Optimal, UnevenlySpacedPointsOfACurveTakeNoLongerThanItsEvenlySpacedOnes) {
  constexpr double quickest = 0.6911;  // s, of 401 evenly spaced points
  for (const auto& [tolerance, share] : {std::pair{1e-6, 0.0}, {3e-4, 0.5}, {1e-4, 0.9}})
    EXPECT_LT(optimal(at_random_places(101, tolerance, share, 6)).duration(), 1.01 * quickest) << tolerance;
}

TEST(Optimal, NoiseOfManySpacingsDoesNotTurnTheHeadBackAtAnEnd) {
  Random random(3);
  constexpr int n = 1501;
  constexpr double tolerance = 3e-3;
  std::vector<Vec> points;
  for (int i = 0; i < n; ++i) {
    const double angle = M_PI / 2 * i / (n - 1), e = i > 0 && i + 1 < n ? 0.9 * tolerance * random.uniform() : 0,
                 way = 2 * M_PI * random.uniform();
    points.push_back({std::cos(angle) + e * std::cos(way), std::sin(angle) + e * std::sin(way)});
  }
  ProbeProblem p = problem(std::move(points), 0.05);
  p.point_tolerance = tolerance;
  merge_points(p);
  EXPECT_LT(optimal(p).duration(), 1.01 * 0.2691);
}

TEST(Optimal, DensePointsOfAStraightCostNothingWithNoiseOrWithout) {
  for (const int n : {11, 401, 3000})
    for (const double share : {0.0, 0.9}) {
      const ProbeMotion plan = optimal(dense(true, n, share * 3e-4, 3e-4));
      EXPECT_LT(plan.duration(), 1.0001 * 0.67) << n << " " << share;
      for (double t = 0; t < plan.duration(); t += 0.01) EXPECT_EQ(plan.motion->evaluate(t)[0][1], 0) << t;
    }
}

TEST(Optimal, APointAtTheBeginThatIsPassedOnTheWayCounts) {
  const ProbeProblem p = problem({{0, 0}, {3, 0}, {0, 0}, {3, 0}, {0, 2}}, 0.05);
  EXPECT_LT(optimal(p).duration(), 0.9 * stops(p).duration());
}

TEST(Optimal, PointsOfARowBeforeASharpCornerArePassedOnTheRow) {
  optimal(problem({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {3.2, 0.5}, {2.4, 1}, {1.6, 1.5}}, 0));
}

TEST(Optimal, PointsOnAStraightTakeTheTimeOfSnapAloneWhereNothingElseLimits) {
  for (const double tolerance : {0.0, 0.05}) {
    const ProbeProblem p =
        problem({{0, 0}, {1.4, 0}, {3.1, 0}, {5.2, 0}, {8.8, 0}, {10, 0}}, tolerance, 2, 1e5, 1e8, 1e11);
    EXPECT_LT(optimal(p).duration(), 1.002 * std::pow(384 * 10 / 200000.0, 0.25)) << tolerance;
  }
}

TEST(Optimal, ThreePointsHaveNoRippleAndTheSearchEnds) {
  ProbeProblem p = problem({{0, 0}, {4, 0}, {4, 3}}, 0.2);
  p.objective = ProbeObjective::ripple;
  EXPECT_EQ(probe_figures(p, optimal(p), silent_scope()).speed_ripple, 0);
}

TEST(Optimal, MoreTimeLeavesNoMoreRipple) {
  ProbeProblem p = problem({{0, 0}, {0.4, 0}, {0.4, 0.3}, {0.7, 0.3}}, 0.02);
  p.objective = ProbeObjective::ripple;
  double before = 1e9;
  for (const double stretch : {2.0, 6.0}) {
    p.stretch = stretch;
    const double ripple = probe_figures(p, optimal(p), silent_scope()).speed_ripple;
    EXPECT_LE(ripple, 1.02 * before) << stretch;
    before = ripple;
  }
}

TEST(Optimal, RandomSetsAreRightNeverSlowerThanRestsAndNeverBelowTheBound) {
  Random random(5);
  for (int i = 0; i < bahnwerk::testing::cases(12); ++i) {
    const std::size_t dimension = i % 2 ? 3 : 2;
    const double spacing = std::exp(random.uniform() * 6 - 3);
    std::vector<Vec> points{{0, 0, 0}};
    for (int n = 2 + static_cast<int>(random.uniform() * 12); n-- > 0;) {
      Vec step{random.uniform() - 0.5, random.uniform() - 0.5, dimension == 3 ? random.uniform() - 0.5 : 0};
      points.push_back(points.back() + 2 * spacing * step);
    }
    const double scale = std::exp(random.uniform() * 4 - 2);
    const ProbeProblem p = problem(points, i % 4 == 3 ? 0 : spacing * std::exp(-5 * random.uniform()), dimension,
                                   20 * scale, 200 * scale, 4000 * scale, 200000 * scale);
    const double planned = optimal(p).duration();
    EXPECT_LE(planned, stops(p).duration()) << i;
    EXPECT_LE(bound(p), planned) << i;
    EXPECT_GT(bound(p), 0) << i;
  }
}

TEST(Optimal, RippleIsNoMoreThanThatOfTheQuickestMotion) {
  // Edges of 0.5 mm with a wide tube, and a row that turns back.
  struct Case {
    std::vector<Vec> points;
    double tolerance;
  };
  const std::vector<Case> cases{{{{0, 0}, {0.5, 0}, {0.9, 0.3}, {0.9, 0.7}}, 0.04},
                                {{{0, 0}, {0.3, 0}, {0.7, 0}, {0.4, 0}, {0.6, 0.1}}, 0.002}};
  for (const auto& [points, tolerance] : cases) {
    ProbeProblem p = problem(points, tolerance);
    const double quickest = probe_figures(p, optimal(p), silent_scope()).speed_ripple;
    p.objective = ProbeObjective::ripple;
    p.stretch = 3;
    EXPECT_LE(probe_figures(p, optimal(p), silent_scope()).speed_ripple, quickest);
  }
}

TEST(Optimal, RippleIsLessWithinTheStretchedTime) {
  ProbeProblem p = problem({{0, 0}, {8, 0}, {8, 6}, {14, 6}, {14, 0}, {22, 0}}, 0.2);
  const ProbeMotion quickest = optimal(p);
  p.objective = ProbeObjective::ripple;
  p.stretch = 1.4;
  const ProbeMotion even = optimal(p);
  EXPECT_LE(even.duration(), 1.4 * quickest.duration());
  EXPECT_LT(probe_figures(p, even, silent_scope()).speed_ripple,
            0.6 * probe_figures(p, quickest, silent_scope()).speed_ripple);
}

TEST(Optimal, ItEndsWhenProgressSaysSo) {
  struct Stop final : ProgressSink {
    void report(std::string_view, double, std::string_view) override {
      if (++calls > 5) throw Stopped(StopReason::cancelled);
    }
    int calls = 0;
  } stop;
  const ProbeProblem p = problem(circle(40, 6), 0.05);
  EXPECT_THROW(plan_optimal(p, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk
