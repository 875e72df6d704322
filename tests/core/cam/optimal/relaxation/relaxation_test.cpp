#include "core/cam/optimal/relaxation/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

/// From rest to rest the best of all laws has a trapezoidal acceleration with ramps r of the duration: J = w₁ 2h/T +
/// A/(½ − r) + B/(r (½ − r)), A = w₂ 2h/T², B = w₃ 2h/T³, stationary at r = (−B + √(B² + AB/2))/A, where
/// its jerk is dear enough for a velocity without plateau.
TEST(Relaxation, ReachesTheClosedFormFromBelow) {
  Progress progress;
  for (const double jerk_weight : {1.0, 2.0, 4.0}) {
    MotionLawProblem problem = testing::rest_to_rest(25, 0.4);
    problem.objective.weight[3] *= jerk_weight;
    const auto& w = problem.objective.weight;
    const double h = 25, t = 0.4, a = w[2] * 2 * h / (t * t), b = w[3] * 2 * h / (t * t * t);
    const double r = (-b + std::sqrt(b * b + a * b / 2)) / a;
    const double closed = w[1] * 2 * h / t + a / (0.5 - r) + b / (r * (0.5 - r));
    const LawTask task = make_law_task(problem);
    const LawBasis basis(task, 7, 1);
    const KnownLaw law(task, basis, testing::solve(task, basis));
    const double bound = relaxation_bound(task, task.at, law, {}, progress);
    EXPECT_LE(bound, closed * (1 + 1e-9));
    EXPECT_GE(bound, closed * (1 - 5e-4));
  }
}

/// No law that exists is better, whatever its degree and pieces.
TEST(Relaxation, IsBelowEveryLaw) {
  Progress progress;
  Random random(4);
  for (int k = 0; k < 12; ++k) {
    const LawTask task = make_law_task(testing::random_problem(random));
    const LawBasis basis(task, 7, 1), fine(task, 4, 12);
    const SplineResult spline = testing::solve(task, basis), close = testing::solve(task, fine);
    RelaxationOptions options;
    options.cells = 120;
    const double bound = relaxation_bound(task, task.at, KnownLaw(task, basis, spline), options, progress);
    EXPECT_LE(bound, std::min(spline.objective, close.objective) * (1 + 1e-9)) << k;
    EXPECT_GE(bound, 0.9 * close.objective) << k;
  }
}

/// A dwell has no acceleration at its ends, whatever the grid: what lies beside it is bounded as between rests.
TEST(Relaxation, BesideADwellIsAsCloseAsBetweenRests) {
  Progress progress;
  MotionLawProblem alone = testing::rest_to_rest(25, 0.4), behind = testing::rest_to_rest(25, 0.8);
  behind.objective.weight = alone.objective.weight;
  behind.length = 180;
  behind.points[0] = testing::point_at(0, {testing::fixed(0)});
  behind.points[1] = testing::point_at(90, {testing::fixed(0)});
  behind.points[0].section[1] = {0, 0};
  behind.points.push_back(testing::point_at(180, {testing::fixed(25), testing::fixed(0), testing::fixed(0)}));
  double bound[2];
  for (const auto* problem : {&alone, &behind}) {
    const LawTask task = make_law_task(*problem);
    const LawBasis basis(task, 7, 1);
    const KnownLaw law(task, basis, testing::solve(task, basis));
    bound[problem == &behind] = relaxation_bound(task, task.at, law, {}, progress);
  }
  EXPECT_NEAR(bound[1], bound[0], 1e-3 * bound[0]);
}

/// A dwell whose height is free, between a rise and a return around a cycle, in every place of the list of points: the
/// bound does not depend on where the cycle begins, and a law at any height keeps it.
TEST(Relaxation, ADwellOfFreeHeightTakesPartWhereverTheCycleBegins) {
  Progress progress;
  const double at[] = {0, 80, 140, 260}, low[] = {0, 20, 20, 5}, high[] = {0, 24, 24, 8};
  double least = 0, most = 1e300, law_there = 1e300;
  for (std::size_t begin = 0; begin < 4; ++begin) {
    MotionLawProblem problem;
    problem.method = LawMethod::optimal;
    problem.periodic = true;
    problem.length = 360;
    problem.cycle_duration = 0.36;
    problem.objective.weight = {0, 1, 0.02, 0.0005};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t i = (begin + k) % 4;
      problem.points.push_back(testing::point_at(at[i] + (i < begin ? 360 : 0), {Range{low[i], high[i]}}));
      if (i == 1) problem.points.back().section[1] = {0, 0};
    }
    const LawTask task = make_law_task(problem);
    const LawBasis basis(task, 6, 4);
    const SplineResult spline = testing::solve(task, basis);
    const double bound = relaxation_bound(task, task.at, KnownLaw(task, basis, spline), {}, progress);
    least = std::max(least, bound), most = std::min(most, bound), law_there = std::min(law_there, spline.objective);
  }
  EXPECT_LE(least, law_there);
  EXPECT_GE(most, 0.9 * law_there);
  EXPECT_LE(least - most, 2e-3 * least);
}

/// Where acceleration may jump, laws below the bound of smooth ones exist: the nodes there are two.
TEST(Relaxation, JumpsThatAPointAllowsCountAsLaws) {
  Progress progress;
  MotionLawProblem problem = testing::rest_to_rest(0, 1);
  problem.points.insert(problem.points.begin() + 1, testing::point_at(45, {testing::fixed(20)}, 1));
  LawTask task = make_law_task(problem);
  const LawBasis basis(task, 5, 4);
  const SplineResult jumping = testing::solve(task, basis);
  const double bound = relaxation_bound(task, task.at, KnownLaw(task, basis, jumping), {}, progress);
  EXPECT_LE(bound, jumping.objective);
  problem.points[1].continuity = 2;
  task = make_law_task(problem);
  const SplineResult smooth = testing::solve(task, basis);
  EXPECT_GE(relaxation_bound(task, task.at, KnownLaw(task, basis, smooth), {}, progress), bound * (1 - 1e-4));
}

}  // namespace
}  // namespace bahnwerk::cam
