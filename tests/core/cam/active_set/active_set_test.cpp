#include "core/cam/active_set/active_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/core/cam/problems.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk::cam {
namespace {

using namespace testing_problems;

LawSolution solved(const MotionLawProblem& problem, const ActiveSetOptions& options = {}) {
  Progress progress;
  Expected<LawSolution, NoLaw> found = solve_active_set(problem, angles(problem), progress, options);
  if (!found) throw Infeasible("no order of conversions ends");
  return *std::move(found);
}
std::vector<std::string> fault_places(const MotionLawProblem& problem) {
  std::vector<std::string> out;
  try {
    solved(problem);
  } catch (const InvalidInput& invalid) {
    for (const InputFault& fault : invalid.faults) {
      std::string place;
      for (const auto& part : fault.place) place += "/" + part;
      out.push_back(place);
    }
  }
  return out;
}

/// Rest, a position range in the middle, rest.
MotionLawProblem through_a_range() {
  return problem(130, false, {rest(0, 0), point(55, 3, {{24, 26}}), rest(130, 45)});
}

TEST(ActiveSet, OneSectionFromRestToRestIsThePolynomialOfDegreeFive) {
  const LawSolution found = solved(problem(100, false, {rest(0, 0), rest(100, 40)}));
  EXPECT_EQ(found.degrees, std::vector<int>{5});
  EXPECT_NEAR(found.value.peaks[1].value, 1.875 * 0.4, 1e-14);
  EXPECT_NEAR(found.value.peaks[2].value, 10 / std::sqrt(3.0) * 40 / 1e4, 1e-15);
  EXPECT_NEAR(found.value.peaks[3].value, 60 * 40 / 1e6, 1e-15);
  EXPECT_NEAR(*found.condition, 6.1776, 0.1);
}

TEST(ActiveSet, AViolatedRangeBecomesAValueAndTiesOfDegreesAreCompared) {
  const LawSolution found = solved(through_a_range());
  ASSERT_EQ(found.conversions.size(), 1u);
  EXPECT_EQ(found.conversions[0], (Conversion{1, 0, 24, false}));
  EXPECT_EQ(found.distributions, 2u);  // degrees 4, 5 and 5, 4
  EXPECT_EQ(found.degrees, (std::vector<int>{4, 5}));
  EXPECT_NEAR(found.value.objective, 3.29793321, 1e-8);
  EXPECT_NEAR(found.law.evaluate(55, 0), 24, 1e-12);
  EXPECT_NEAR(*found.condition, 13.7652, 0.2);
}

TEST(ActiveSet, DegreeTwentyOneIsTheIncompleteBetaFunction) {
  std::vector<Range> still(11, number(0)), there = still;
  there[0] = number(60);
  const LawSolution found = solved(problem(120, false, {point(0, 0, still), point(120, 0, there)}));
  EXPECT_EQ(found.degrees, std::vector<int>{21});
  // The velocity is 60/120 x¹⁰(1 − x)¹⁰/B(11, 11), B(11, 11) = 10! 10!/21!.
  const double beta = std::exp(2 * std::lgamma(11.0) - std::lgamma(22.0));
  EXPECT_NEAR(found.value.peaks[1].value, 0.5 / (1024.0 * 1024.0 * beta), 1e-10);
  EXPECT_NEAR(found.value.objective, 13.7094574981946, 1e-7);
}

/// With lopsided shares of the conditions derivatives grow from section to section: to 10²⁴ of the sine's over 60
/// points.
TEST(ActiveSet, HundredsOfPositionsOfASineGiveASine) {
  std::vector<MotionPoint> points{rest(0, 0)};
  for (int i = 1; i < 400; ++i) points.push_back(point(i, 2, {number(10 * std::sin(0.5 * i))}));
  points.push_back(rest(400, 10 * std::sin(200)));
  const LawSolution found = solved(problem(400, false, points));
  for (double x = 20; x < 380; x += 0.25) EXPECT_NEAR(found.law.evaluate(x, 1), 5 * std::cos(0.5 * x), 0.02) << x;
}

TEST(ActiveSet, FourPointsOfAPeriodicLawWithContinuityThreeAreSingular) {
  const auto places = fault_places(problem(360, true,
                                           {point(0, 3, {number(0)}), point(80, 3, {number(18)}),
                                            point(180, 3, {number(30)}), point(280, 3, {number(12)})}));
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places.front().rfind("/points/", 0), 0u);
}

TEST(ActiveSet, TwentyPositionsWithContinuityThreeAreJoinedByTheNextDistributionOfDegrees) {
  std::vector<MotionPoint> points;
  for (int i = 0; i < 20; ++i) points.push_back(point(18 * i, 3, {number(10 * std::sin(i * std::numbers::pi / 10))}));
  const LawSolution found = solved(problem(360, true, points));
  EXPECT_EQ(*std::max_element(found.degrees.begin(), found.degrees.end()), 5);
  EXPECT_EQ(std::accumulate(found.degrees.begin(), found.degrees.end(), 0), 80);
  EXPECT_LT(*found.condition, 1000);
  for (double x = 0; x < 360; x += 1)
    EXPECT_NEAR(found.law.evaluate(x, 0), 10 * std::sin(x * std::numbers::pi / 180), 0.02) << x;
}

TEST(ActiveSet, ThreeConditionsOfRankTwoAreNamed) {
  const auto places = fault_places(
      problem(10, false, {point(0, 2, {number(0), Range{}, number(1)}), point(10, 2, {Range{}, Range{}, number(2)})}));
  EXPECT_EQ(places, (std::vector<std::string>{"/points/0/acceleration", "/points/1/acceleration"}));
}

TEST(ActiveSet, ADegreeAboveTwentyOneIsNamedAtBothEnds) {
  std::vector<Range> twelve(12, number(0));
  const auto places = fault_places(problem(100, false, {point(0, 0, twelve), point(100, 0, twelve)}));
  EXPECT_EQ(places, (std::vector<std::string>{"/points/0", "/points/1"}));
}

TEST(ActiveSet, ASectionWithoutAnyConditionIsNamed) {
  EXPECT_EQ(fault_places(problem(100, false, {point(0, 2, {}), point(100, 2, {})})),
            std::vector<std::string>{"/points/0"});
}

TEST(ActiveSet, ASectionLimitThatTheMethodBreaksIsNamed) {
  MotionLawProblem broken = problem(100, false, {rest(0, 0), rest(100, 40)});
  broken.points[0].section[1] = {0, 0.7};
  EXPECT_EQ(fault_places(broken), std::vector<std::string>{"/points/0/section/velocity"});
}

/// A random law of three to seven points with values and ranges.
MotionLawProblem random_problem(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto n = 3 + random() % 5;
  const bool periodic = random() % 2 == 0;
  std::vector<MotionPoint> points;
  double at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double position = 50 * unit(random);
    MotionPoint p = point(at, 2 + static_cast<int>(random() % 2), {number(position)});
    if (random() % 2) p.values.push_back({-0.2 * unit(random), 0.2 * unit(random)});
    if (i > 0 && random() % 3 == 0) p.values[0] = {position - 2, position + 2};
    points.push_back(p);
    at += 10 + 50 * unit(random);
  }
  if (!periodic) at = points.back().at.min, points.front() = rest(0, 10), points.back() = rest(at, 30);
  return problem(at, periodic, points);
}

TEST(ActiveSet, RandomLawsKeepAllValuesRangesAndContinuity) {
  std::mt19937 random(38);
  int found = 0;
  for (int i = 0; i < testing::cases(150); ++i) {
    const MotionLawProblem problem = random_problem(random);
    LawSolution solution;
    try {
      solution = solved(problem);
    } catch (const PlanningError&) {
      continue;  // singular, or no order of conversions ends
    }
    ++found;
    const CamLaw& law = solution.law;
    const auto times = section_times(problem, solution.at);
    for (std::size_t p = 0; p < problem.points.size(); ++p) {
      const bool last = !problem.periodic && p + 1 == problem.points.size();
      for (int r = 0; r <= problem.continuity(p); ++r) {
        const double size = law.peak(r).value, value = law.in_piece(last ? p - 1 : p, last ? 1 : 0, r);
        EXPECT_GE(value, problem.points[p].value(r).min - 1e-9 * size) << i << " " << p << " " << r;
        EXPECT_LE(value, problem.points[p].value(r).max + 1e-9 * size) << i << " " << p << " " << r;
        if (last || (p == 0 && !problem.periodic)) continue;
        const std::size_t before = p == 0 ? law.pieces() - 1 : p - 1;
        EXPECT_NEAR(law.in_piece(before, 1, r), value, 1e-9 * size) << i << " " << p << " " << r;
      }
    }
  }
  EXPECT_GT(found, testing::cases(150) / 2);
}

TEST(ActiveSet, ScaledTimeAndStrokeScaleThePeaksAndNothingElse) {
  const LawSolution plain = solved(through_a_range());
  MotionLawProblem scaled = through_a_range();
  scaled.cycle_duration = *scaled.cycle_duration / 1024;
  for (MotionPoint& p : scaled.points) p.values[0] = {p.values[0].min * 8, p.values[0].max * 8};
  double factor = 8;
  for (std::size_t r = 1; r < 4; ++r) scaled.objective.weight[r] /= factor *= 1024;
  const LawSolution found = solved(scaled);
  EXPECT_NEAR(found.value.objective, 3 * plain.value.objective - 2 * plain.value.objective, 1e-9);
  EXPECT_EQ(found.degrees, plain.degrees);
}

TEST(ActiveSet, AnotherOrderOfConversionIsTakenWhereItIsBetter) {
  std::mt19937 random(5);
  int better = 0;
  for (int i = 0; i < 60; ++i) {
    const MotionLawProblem problem = random_problem(random);
    try {
      ActiveSetOptions source;
      source.source_order_only = true;
      const LawSolution all = solved(problem), first = solved(problem, source);
      EXPECT_LE(all.value.objective, first.value.objective * (1 + 1e-12));
      if (!all.source_order) continue;
      ++better;
      EXPECT_GT(all.source_order->objective, all.value.objective);
    } catch (const PlanningError&) {
    }
  }
  EXPECT_GT(better, 0);
}

}  // namespace
}  // namespace bahnwerk::cam
