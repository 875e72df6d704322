/// The least J with fixed angles: closed cases, a brute search, and what every result has to keep.
#include "core/cam/optimal/program/spline_program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/cam/optimal/task/extrema.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

SplineResult solve(const LawTask& task, int degree, int pieces) {
  return testing::solve(task, LawBasis(task, degree, pieces));
}

TEST(SplineProgram, SixValuesAndDegreeFiveAreThe345Polynomial) {
  const double h = 30, t = 0.6;
  const MotionLawProblem problem = testing::rest_to_rest(h, t);
  const SplineResult result = solve(make_law_task(problem), 5, 1);
  const auto& w = problem.objective.weight;
  const double expected = w[1] * 1.875 * h / t + w[2] * 10 / std::sqrt(3.0) * h / (t * t) + w[3] * 60 * h / (t * t * t);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.objective, expected, 1e-9 * expected);
  EXPECT_NEAR(result.lower, expected, 1e-7 * expected);
}

/// Degree 7 leaves two coefficients; the optimum is symmetric, one is left: a golden section search over sampled peaks.
TEST(SplineProgram, DegreeSevenIsTheBestOfASearch) {
  const double h = 30, t = 0.6;
  const MotionLawProblem problem = testing::rest_to_rest(h, t);
  const auto& w = problem.objective.weight;
  const auto objective = [&](double a) {
    std::vector<double> b{0, 0, 0, a * h, (1 - a) * h, h, h, h};
    double sum = 0;
    for (int r = 1; r <= 3; ++r) {
      differentiate_bernstein(b);
      for (double& each : b) each /= t;
      double peak = 0;
      for (int k = 0; k <= 4000; ++k) peak = std::max(peak, std::abs(evaluate_bernstein(b, k / 4000.0)));
      sum += w[static_cast<std::size_t>(r)] * peak;
    }
    return sum;
  };
  double low = -1, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double a = low + 0.382 * (high - low), c = low + 0.618 * (high - low);
    (objective(a) < objective(c) ? high : low) = objective(a) < objective(c) ? c : a;
  }
  const double best = objective((low + high) / 2);
  const SplineResult result = solve(make_law_task(problem), 7, 1);
  EXPECT_NEAR(result.objective, best, 1e-6 * best);
  EXPECT_TRUE(result.converged);
}

/// Random problems: J is between the dual's value and every other degree's, and all conditions hold.
TEST(SplineProgram, ResultsAreProvenAndKeepTheirConditions) {
  Random random(21);
  int proven = 0;
  constexpr int count = 25;
  for (int k = 0; k < count; ++k) {
    const LawTask task = make_law_task(testing::random_problem(random));
    const SplineResult seven = solve(task, 7, 1), eight = solve(task, 8, 1), halves = solve(task, 7, 2);
    ASSERT_TRUE(seven.feasible && eight.feasible && halves.feasible) << k;
    proven += seven.converged;
    EXPECT_LE(seven.lower, seven.objective * (1 + 1e-9));
    EXPECT_LE(seven.objective - seven.lower, 1e-4 * seven.objective) << k;
    EXPECT_LE(eight.lower, seven.objective * (1 + 1e-8)) << k;
    EXPECT_LE(halves.lower, seven.objective * (1 + 1e-8)) << k;
    EXPECT_LE(eight.objective, seven.objective * (1 + 1e-4)) << k;
    EXPECT_LE(seven.violation, 1e-8) << k;
    const LawBasis basis(task, 7, 1);
    std::vector<double> weights(8);
    ASSERT_EQ(basis.size(), 8 * task.sections());
    const auto derivative = [&](std::size_t section, double v, int order) {
      basis.section(section).weights(0, v, static_cast<std::size_t>(order), weights.data());
      double sum = 0;
      for (std::size_t i = 0; i < 8; ++i) sum += weights[i] * seven.coefficients[section * 8 + i];
      return sum / std::pow(seven.breaks[section + 1] - seven.breaks[section], order);
    };
    for (std::size_t section = 0; section < task.sections(); ++section) {
      const std::size_t end = task.end_point(section);
      if (!task.periodic && section + 1 == task.sections()) continue;
      for (int r = 0; r <= task.continuity[end]; ++r)
        EXPECT_NEAR(derivative(section, 1, r), derivative(end, 0, r), 1e-7 * std::pow(8, r)) << k;
    }
    for (const LawTask::Condition& condition : task.conditions) {
      const bool last = condition.point == task.sections();
      const double value = derivative(last ? condition.point - 1 : condition.point, last ? 1 : 0, condition.order);
      EXPECT_GE(value, condition.range.min - 1e-7) << k;
      EXPECT_LE(value, condition.range.max + 1e-7) << k;
    }
  }
  EXPECT_GE(proven, count - 3);
}

/// The first of 16 pieces reaches 0.01 mm of 30: its value is the condition's but for its own rounding.
TEST(SplineProgram, ValuesHoldToTheRoundingOfSmallPieces) {
  MotionLawProblem problem = testing::rest_to_rest(30, 0.065);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(49, {Range{18.8, 22.8}}, 3));
  const LawTask task = make_law_task(problem);
  const SplineResult result = solve(task, 5, 16);
  EXPECT_NEAR(result.coefficients[0] * task.unit_position + task.origin, 0, 1e-15);
}

/// A law that stays just inside its limits of velocity and acceleration touches them between the samples.
TEST(SplineProgram, LimitsThatAreTouchedInsideASectionConverge) {
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(25, {Range{17, 19}}, 3));
  problem.points[0].section[2] = {-700, 700};
  problem.points[1].section[1] = {0, 100};
  problem.points[1].section[0].max = 30.01;
  for (const int degree : {7, 9, 12}) {
    const SplineResult result = solve(make_law_task(problem), degree, 1);
    EXPECT_TRUE(result.converged) << degree << ' ' << result.objective << ' ' << result.lower << ' '
                                  << result.violation;
  }
}

/// A stroke of 30 with a rest in between overshoots unless the section says otherwise.
TEST(SplineProgram, SectionLimitsHoldBetweenTheirSamples) {
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(25, {Range{17, 19}}, 3));
  const SplineResult free = solve(make_law_task(problem), 6, 1);
  problem.points[0].section[1].min = problem.points[1].section[1].min = 0;
  const LawTask task = make_law_task(problem);
  const SplineResult limited = solve(task, 6, 1);
  ASSERT_TRUE(limited.feasible);
  EXPECT_GT(limited.objective, free.objective * 1.001);
  for (std::size_t section = 0; section < 2; ++section) {
    const LawBasis basis(task, 6, 1);
    std::vector<double> b(6);
    basis.section(section).bernstein(0, limited.coefficients.data() + basis.first(section), 1, b.data());
    for (double& each : b) each = -each;
    EXPECT_LE(greatest_value(b).value, 1e-9);
  }
}

/// A spline of some pieces is one of twice as many.
TEST(SplineProgram, MorePiecesThatDivideTheSectionsAreNeverWorse) {
  Random random(5);
  for (int k = 0; k < 6; ++k) {
    MotionLawProblem problem = testing::random_problem(random);
    if (k % 2 == 0)
      problem.points[1].at = {problem.points[2].at.min - 1, problem.points[2].at.min - 1};  // a short section
    const LawTask task = make_law_task(problem);
    double last = 1e300;
    for (const int pieces : {1, 2, 4, 8}) {
      const SplineResult result = solve(task, 7, pieces);
      if (!result.feasible) continue;
      EXPECT_LE(result.objective, last * (1 + 5e-9)) << k << ' ' << pieces;
      last = result.objective;
    }
  }
}

/// Two points 0.1 deg apart say what a velocity says.
TEST(SplineProgram, AShortSectionIsWorthAVelocity) {
  MotionLawProblem slow = testing::rest_to_rest(10, 1), pair = slow;
  slow.points.insert(slow.points.begin() + 1, testing::point_at(45, {testing::fixed(5), testing::fixed(10)}, 3));
  pair.points.insert(pair.points.begin() + 1, testing::point_at(45, {testing::fixed(5)}, 3));
  pair.points.insert(pair.points.begin() + 2, testing::point_at(45.025, {testing::fixed(5 + 10 * 0.025 / 90)}, 3));
  const double with_velocity = solve(make_law_task(slow), 5, 8).objective;
  EXPECT_NEAR(solve(make_law_task(pair), 5, 8).objective, with_velocity, 1e-3 * with_velocity);
}

TEST(SplineProgram, ContradictionsAreNamed) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  LawTask task = make_law_task(problem);
  const LawBasis four(task, 4, 1), five(task, 5, 1);
  const LawConflict values = SplineProgram(task, four, task.middle()).find_conflict(progress);
  EXPECT_TRUE(values.values);
  EXPECT_EQ(values.conditions.size(), 6u);
  problem.points[0].section[1].max = 40;  // 56.25 at least
  task = make_law_task(problem);
  const LawConflict limit = SplineProgram(task, five, task.middle()).find_conflict(progress);
  EXPECT_FALSE(limit.values);
  EXPECT_GT(limit.violation, 0.01);
  ASSERT_EQ(limit.limits.size(), 1u);
  EXPECT_EQ(limit.limits[0], std::pair(std::size_t{0}, 1));
}

/// Near a rest a limit of velocity leaves a law next to no room; steps in coefficients and angles converge there, too,
/// at any radius.
TEST(SplineProgram, JointStepsOfMonotoneLawsConverge) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(50, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(45, {testing::fixed(25)}, 3));
  problem.points[1].at = {15, 75};
  for (std::size_t section = 0; section < 2; ++section) problem.points[section].section[1].min = 0;
  const LawTask task = make_law_task(problem);
  const LawBasis basis(task, 7, 1);
  const double room = task.at[1].max - task.at[1].min;
  for (const double share : {0.2, 0.35, 0.5, 0.6, 0.85}) {
    std::vector<double> times = task.middle();
    times[1] = task.at[1].min + share * room;
    SplineOptions coarse;
    coarse.gap = 1e-4;
    const SplineResult law = SplineProgram(task, basis, times).solve(coarse, progress);
    ASSERT_TRUE(law.feasible) << share;
    for (const double radius : {0.1 * room, 1e-2 * room, 1e-4 * room}) {
      const JointReference reference{law.coefficients, {0, radius, 0}};
      const JointStep step = SplineProgram(task, basis, times, &reference).joint_step(law.samples, progress);
      EXPECT_TRUE(step.converged) << share << ", " << radius;
      EXPECT_LE(step.objective, law.objective * (1 + 1e-6)) << share << ", " << radius;
      EXPECT_LE(std::abs(step.times[1] - times[1]), radius * (1 + 1e-9));
    }
  }
}

}  // namespace
}  // namespace bahnwerk::cam
