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
  SilentProgress progress;
  MotionLawProblem problem = driven(30, {});
  problem.drive->jerk = 9000;
  problem.degree = 5;
  const ShortestCycle cycle = find_shortest_cycle(problem, progress);
  EXPECT_NEAR(cycle.duration, std::cbrt(60 * 30 / 9000.0), 1e-6);
  EXPECT_TRUE(cycle.monotone);
  EXPECT_LE(cycle.too_short, cycle.duration);
  EXPECT_GE(cycle.too_short, cycle.duration * (1 - 1e-5));
}

/// No law is faster than seven segments of constant jerk: T = h/V + V/A + A/J where all limits are reached.
TEST(Drive, ManyPiecesComeCloseToSevenSegments) {
  SilentProgress progress;
  MotionLawProblem problem = driven(40, {80, 900, 20000});
  problem.degree = 3;
  problem.pieces = 16;
  const double bound = 40.0 / 80 + 80.0 / 900 + 900.0 / 20000;
  const ShortestCycle cycle = find_shortest_cycle(problem, progress);
  EXPECT_GE(cycle.duration, bound);
  EXPECT_LE(cycle.duration, bound * 1.03);
}

/// A law that does not rest at its end: stretching changes its end.
TEST(Drive, ValuesOtherThanZeroAreSaidToBeNoProof) {
  SilentProgress progress;
  MotionLawProblem problem = driven(40, {100, 1000, 20000});
  problem.points.back().values[1] = testing::fixed(50);
  problem.degree = 7;
  const ShortestCycle cycle = find_shortest_cycle(problem, progress);
  EXPECT_FALSE(cycle.monotone);
  EXPECT_GT(cycle.duration, 0.4);
  EXPECT_LE(cycle.spline.objective, 1);
}

TEST(Drive, NoLimitIsAFault) {
  SilentProgress progress;
  EXPECT_THROW(find_shortest_cycle(driven(40, {}), progress), InvalidInput);
}

}  // namespace
}  // namespace bahnwerk::cam
