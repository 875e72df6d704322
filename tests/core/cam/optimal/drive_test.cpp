#include "core/cam/optimal/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

MotionLawProblem driven(double stroke, DriveLimits drive) {
  MotionLawProblem problem = testing::rest_to_rest(stroke, 1);
  problem.cycle_duration.reset();
  problem.drive = drive;
  return problem;
}

/// The 3-4-5 polynomial's jerk is 60 h/T³: the only law of degree 5.
TEST(Drive, JerkAloneAndDegreeFiveGiveTheCubeRoot) {
  Progress progress;
  MotionLawProblem problem = driven(30, {});
  problem.drive->jerk = 9000;
  problem.degree = 5;
  const ShortestCycle cycle = find_shortest_cycle(problem, progress);
  EXPECT_NEAR(cycle.duration, std::cbrt(60 * 30 / 9000.0), 1e-6);
  ASSERT_TRUE(cycle.bound);
  EXPECT_LE(cycle.bound->duration, std::cbrt(32 * 30 / 9000.0));  // constant jerk in four parts
  EXPECT_GE(cycle.bound->duration, std::cbrt(32 * 30 / 9000.0) * (1 - 1e-3));
}

/// No law is faster than seven segments of constant jerk: T = h/V + V/A + A/J where all limits are reached.
TEST(Drive, ManyPiecesComeCloseToSevenSegments) {
  Progress progress;
  MotionLawProblem problem = driven(40, {80, 900, 20000});
  problem.degree = 3;
  problem.pieces = 16;
  const double bound = 40.0 / 80 + 80.0 / 900 + 900.0 / 20000;
  const ShortestCycle cycle = find_shortest_cycle(problem, progress);
  EXPECT_GE(cycle.duration, bound);
  EXPECT_LE(cycle.duration, bound * 1.03);
}

/// Sections between points that do not rest, where velocity is reached in a small part of them.
TEST(Drive, PiecesAreHalvedUntilTheCycleIsNextToItsBound) {
  Progress progress;
  for (const DriveLimits& drive : {DriveLimits{225, 2817, 4.9e6}, DriveLimits{900, 5000, 1e5}}) {
    MotionLawProblem problem = driven(53.5, drive);
    problem.degree.reset();
    problem.points.insert(problem.points.begin() + 1, testing::point_at(83, {testing::fixed(5.7)}));
    const ShortestCycle cycle = find_shortest_cycle(problem, progress);
    ASSERT_TRUE(cycle.bound);
    EXPECT_GE(cycle.duration, cycle.bound->duration);
    EXPECT_LE(cycle.duration, cycle.bound->duration * 1.003);
  }
}

/// A law that does not rest at its end: stretching changes its end.
TEST(Drive, ValuesOtherThanZeroAreSaidToBeNoProof) {
  Progress progress;
  MotionLawProblem problem = driven(40, {100, 1000, 20000});
  problem.points.back().values[1] = testing::fixed(50);
  problem.degree = 7;
  const ShortestCycle cycle = find_shortest_cycle(problem, progress);
  EXPECT_FALSE(cycle.bound);
  EXPECT_GT(cycle.duration, 0.4);
  EXPECT_LE(cycle.spline.objective, 1);
}

TEST(Drive, AnglesInARangeAreNotSlowerThanANumberInside) {
  Progress progress;
  MotionLawProblem problem = driven(100, {1000, 10000, 1e6});
  problem.degree = 3;
  problem.pieces = 16;
  problem.points.insert(problem.points.begin() + 1, testing::point_at(35, {testing::fixed(30)}));
  const double at_35 = find_shortest_cycle(problem, progress).duration;
  problem.points[1].at = {22, 67};
  EXPECT_LE(find_shortest_cycle(problem, progress).duration, at_35 * (1 + 1e-6));
}

TEST(Drive, PeaksStayBelowTheLimits) {
  Progress progress;
  MotionLawProblem problem = driven(100, {1000, 10000, 1e6});
  problem.points.insert(problem.points.begin() + 1, testing::point_at(40, {testing::fixed(30)}));
  for (const int degree : {5, 9}) {
    problem.degree = degree;
    problem.pieces = 8;
    EXPECT_LT(find_shortest_cycle(problem, progress).spline.objective, 1 - 1e-9);
  }
}

TEST(Drive, WhatNoDriveCanIsAFault) {
  EXPECT_THROW(check_drive(driven(40, {})), InvalidInput);
  EXPECT_THROW(check_drive(driven(0, {100, 1000, 20000})), InvalidInput);
  MotionLawProblem problem = driven(40, {100, 1000, 20000});
  EXPECT_NO_THROW(check_drive(problem));
  problem.points.back().values[1] = testing::fixed(-300);
  EXPECT_THROW(check_drive(problem), InvalidInput);
}

}  // namespace
}  // namespace bahnwerk::cam
