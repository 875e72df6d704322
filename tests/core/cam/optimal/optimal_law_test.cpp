#include "core/cam/optimal/optimal_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// The same problem in other seconds and millimetres.
MotionLawProblem scaled(MotionLawProblem problem, double time, double length) {
  problem.cycle_duration = *problem.cycle_duration * time;
  const auto scale = [&](Range& range, int order) {
    range.min *= length / std::pow(time, order);
    range.max *= length / std::pow(time, order);
  };
  for (MotionPoint& point : problem.points) {
    for (int r = 0; r < static_cast<int>(point.values.size()); ++r) scale(point.values[static_cast<std::size_t>(r)], r);
    for (int r = 0; r < limited_orders; ++r) scale(point.section[static_cast<std::size_t>(r)], r);
  }
  for (int r = 1; r < limited_orders; ++r) problem.objective.weight[static_cast<std::size_t>(r)] *= std::pow(time, r);
  return problem;
}

TEST(OptimalLaw, TimeAndStrokeScaleJAndNothingElse) {
  Progress progress;
  Random random(2);
  for (int k = 0; k < 4; ++k) {
    MotionLawProblem problem = testing::random_problem(random);
    problem.degree = 7;
    const OptimalLaw one = plan_optimal_law(problem, progress),
                     other = plan_optimal_law(scaled(problem, 0.03, 7), progress);
    EXPECT_NEAR(other.solution.value.objective, 7 * one.solution.value.objective,
                1e-6 * other.solution.value.objective);
    EXPECT_NEAR(other.solution.bound->objective, 7 * one.solution.bound->objective,
                1e-4 * other.solution.value.objective);
    EXPECT_LE(one.solution.bound->objective, *one.solution.lower * (1 + 1e-9));
  }
}

TEST(OptimalLaw, WithoutDegreeItComesWithinAHundredthOfAllLaws) {
  Progress progress;
  const OptimalLaw law = plan_optimal_law(testing::rest_to_rest(30, 0.5), progress);
  EXPECT_LE(law.solution.value.objective, 1.01 * law.solution.bound->objective * (1 + 1e-6));
  EXPECT_EQ(law.degree, 3);
  EXPECT_LE(law.pieces, 16);
  EXPECT_EQ(law.solution.law.pieces(), static_cast<std::size_t>(law.pieces));
}

TEST(OptimalLaw, AWeightedSectionBetweenRestsHasItsOwnOptimum) {
  Progress progress;
  const auto alone = [&](double angle) {
    MotionLawProblem problem = testing::rest_to_rest(30, angle / 360);
    problem.objective.weight = {0, 1, 0.05, 0.001};
    problem.degree = 7;
    return plan_optimal_law(problem, progress).solution;
  };
  const LawSolution rise = alone(60), back = alone(300);
  MotionLawProblem both = testing::rest_to_rest(30, 1);
  both.objective.weight = {0, 1, 0.05, 0.001};
  both.length = 360;
  both.degree = 7;
  both.points[1].at = {60, 60};
  both.points.push_back(both.points[0]);
  both.points[2].at = {360, 360};
  for (const double weight : {0.01, 1.0, 100.0}) {
    both.points[1].weight = weight;
    const LawSolution law = plan_optimal_law(both, progress).solution;
    const double sum = rise.value.objective + weight * back.value.objective;
    EXPECT_NEAR(law.value.objective, sum, 1e-7 * sum) << weight;
    EXPECT_LE(law.bound->objective, law.value.objective);
    EXPECT_GE(law.bound->objective, 0.9 * law.value.objective);
  }
}

TEST(OptimalLaw, WithWeightsItIsNotWorseThanTheLawWithoutAndKeepsItsBound) {
  Progress progress;
  Random random(11);
  for (int k = 0; k < 5; ++k) {
    MotionLawProblem problem = testing::random_problem(random);
    problem.degree = 7;
    if (k == 4) problem.points[1].at.max += 5;
    const LawSolution without = plan_optimal_law(problem, progress).solution;
    for (std::size_t s = 0; s < problem.sections(); s += 2) problem.points[s].weight = random.uniform(0.2, 5);
    const LawSolution with = plan_optimal_law(problem, progress).solution;
    EXPECT_LE(with.value.objective, evaluate_objective(problem, without.law).objective * (1 + 1e-6));
    EXPECT_LE(with.bound->objective, *with.lower * (1 + 1e-9));
    EXPECT_GT(with.bound->objective, 0.5 * with.value.objective);
  }
}

TEST(OptimalLaw, OvershootIsNotedWithTheLimitThatPreventsIt) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(25, {testing::fixed(20)}, 3));
  problem.degree = 7;
  const OptimalLaw law = plan_optimal_law(problem, progress);
  ASSERT_EQ(law.solution.notes.size(), 1u);
  EXPECT_NE(law.solution.notes[0].find("\"velocity\": {\"min\": 0}"), std::string::npos) << law.solution.notes[0];
  problem.points[0].section[1].min = problem.points[1].section[1].min = 0;
  EXPECT_TRUE(plan_optimal_law(problem, progress).solution.notes.empty());
}

/// A dwell: a section whose velocity is 0 all over.
TEST(OptimalLaw, LimitsThatAreValuesHoldAllOver) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(50, {testing::fixed(30)}));
  problem.points[1].section[1] = {0, 0};
  problem.degree = 6;
  const OptimalLaw law = plan_optimal_law(problem, progress);
  const LawExtremes dwell = law.solution.law.section_extremes(0, 1);
  EXPECT_NEAR(dwell.lowest.value, 30, 1e-8);
  EXPECT_NEAR(dwell.highest.value, 30, 1e-8);
}

TEST(OptimalLaw, FaultsNameTheirPlace) {
  Progress progress;
  const auto place_of = [&](const MotionLawProblem& problem) {
    try {
      plan_optimal_law(problem, progress);
    } catch (const InvalidInput& fault) {
      return fault.faults.front().place;
    }
    return std::vector<std::string>{};
  };
  MotionLawProblem problem = testing::rest_to_rest(30, 1);
  problem.degree = 6;
  problem.points[0].section[1].max = 31;
  EXPECT_EQ(place_of(problem), (std::vector<std::string>{"points", "0", "section", "velocity"}));
  problem.points[0].section[1].max = 1e9;
  problem.points[0].section[0].max = 20;
  EXPECT_EQ(place_of(problem), (std::vector<std::string>{"points", "0", "section", "position"}));
  problem.points[0].section[0].max = 1e9;
  problem.degree = 4;
  EXPECT_EQ(place_of(problem), (std::vector<std::string>{"points", "0", "acceleration"}));
  problem.degree = 6;
  problem.points[0].law = ClassicalLaw::modified_sine;
  problem.points[0].section[1].max = 52;  // its peak is 1.7596 · 30 mm/s
  EXPECT_EQ(place_of(problem), (std::vector<std::string>{"points", "0", "section", "velocity"}));
  problem.points[0].section[1].max = 53;
  EXPECT_EQ(place_of(problem), std::vector<std::string>{});
}

double largest_effort(const EffortLimit& effort, const CamLaw& law) {
  double most = 0;
  for (int k = 0; k <= 2000; ++k) {
    const double t = law.begin() + (law.breaks().back() - law.begin()) * k / 2000;
    double sum = 0;
    for (int r = 0; r < 3; ++r) sum += effort.factor[static_cast<std::size_t>(r)] * law.evaluate(t, r);
    most = std::max(most, std::abs(sum));
  }
  return most;
}

/// A mass on a spring with a damper: the force is linear in the law, at angles that are free, too.
TEST(OptimalLaw, TheForceOfAMassWithSpringAndDamperHoldsAllOver) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(40, 0.4);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(45, {testing::fixed(18)}));
  problem.degree = 5;
  problem.pieces = 6;
  for (const bool free : {false, true}) {
    if (free) problem.points[1].at = {40, 50};
    problem.effort.reset();
    const OptimalLaw without = plan_optimal_law(problem, progress, nullptr);
    EffortLimit effort{{2, 0.3, 0.02}, {}};
    const double limit = 0.97 * largest_effort(effort, without.solution.law);
    effort.range = {-limit, limit};
    problem.effort = effort;
    const OptimalLaw within = plan_optimal_law(problem, progress, nullptr);
    EXPECT_LE(largest_effort(effort, within.solution.law), limit * (1 + 1e-8));
    EXPECT_GE(within.solution.value.objective, without.solution.value.objective * (1 - 1e-6));
  }
  problem.effort->range = {-70, 70};  // the spring alone takes 80 at the end
  try {
    plan_optimal_law(problem, progress, nullptr);
    FAIL() << "no law keeps this";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.faults.front().place, (std::vector<std::string>{"drive", "effort"}));
  }
}

TEST(OptimalLaw, TheDriveDecidesWhereTheCycleHasNoDuration) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(40, 1);
  problem.cycle_duration.reset();
  problem.drive = DriveLimits{100, 1200, 30000};
  problem.degree = 7;
  const OptimalLaw law = plan_optimal_law(problem, progress);
  EXPECT_NEAR(law.solution.law.duration(), law.solution.cycle_duration, 1e-12);
  EXPECT_LE(law.solution.value.peaks[1].value, 100 * (1 + 1e-9));
  EXPECT_LE(law.solution.value.peaks[2].value, 1200 * (1 + 1e-9));
  EXPECT_LE(law.solution.value.peaks[3].value, 30000 * (1 + 1e-9));
  ASSERT_TRUE(law.solution.lower);
  EXPECT_LE(*law.solution.lower, law.solution.value.objective);
  EXPECT_GE(*law.solution.lower, law.solution.bound->objective * (1 - 1e-6));
}

/// Splines of 2 pieces are splines of 4 and of 6, and so on: more of them never make J greater by more than 1e-9.
TEST(OptimalLaw, MorePiecesThatDivideEachOtherAreNeverWorse) {
  Progress progress;
  Random random(11);
  for (int k = 0; k < 2; ++k) {
    MotionLawProblem problem = testing::rest_to_rest(30, 1);
    problem.objective.weight = {0, 1, random.uniform(0.01, 0.3), random.uniform(1e-4, 0.02)};
    problem.points.insert(problem.points.begin() + 1,
                          testing::point_at(random.uniform(5, 80), {testing::fixed(random.uniform(0, 40))}));
    for (const int degree : {5, 9}) {
      problem.degree = degree;
      double least = 1e300;
      for (const int pieces : {1, 2, 4, 8, 16}) {
        problem.pieces = pieces;
        const OptimalLaw law = plan_optimal_law(problem, progress);
        EXPECT_LE(law.solution.value.objective, least * (1 + 1e-9)) << k << ", degree " << degree << ", " << pieces;
        EXPECT_LE(*law.solution.lower, law.solution.value.objective);
        EXPECT_EQ(pieces % law.pieces, 0);
        least = std::min(least, law.solution.value.objective);
      }
    }
  }
}

}  // namespace
}  // namespace bahnwerk::cam
