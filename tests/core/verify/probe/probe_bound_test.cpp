#include "core/verify/probe/probe_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

double bound(const ProbeProblem& problem) {
  Progress silent;
  return probe_bound(problem, silent).value;
}

TEST(ProbeBound, AStraightIsBoundedByItsProfile) {
  // 80 mm along an axis: 80/20 + 20/200 + 200/4000 + 4000/200000 s are needed where the speed is reached.
  const double found = bound(problem({{0, 0, 0}, {0, 80, 0}}, 0.05, 3));
  EXPECT_LE(found, 4.17);
  EXPECT_GT(found, 0.999 * 4.17);
}

TEST(ProbeBound, AShortMoveIsBoundedBySnap) {
  const double least = std::pow(384 * 0.03 / 200000, 0.25);
  // Both ends may be 1e-9 mm off.
  const double found = bound(problem({{0, 0}, {0.03, 0}}, 0.05));
  EXPECT_LE(found, least);
  EXPECT_GT(found, least * (1 - 0.26 * 2e-9 / 0.03));
}

TEST(ProbeBound, WithoutTubeCornersAreRests) {
  const double rests = 2 * (5.0 / 20 + 0.17);
  const double found = bound(problem({{0, 0}, {5, 0}, {5, 5}}, 0));
  EXPECT_LE(found, rests);
  EXPECT_GT(found, 0.995 * rests);
}

TEST(ProbeBound, AWiderTubeDoesNotProveMore) {
  const std::vector<Vec> points = {{0, 0}, {5, 0}, {5, 5}, {9, 9}};
  EXPECT_LE(bound(problem(points, 0.2)), 1.002 * bound(problem(points, 0.05)));
}

TEST(ProbeBound, DensePointsOnACircleAreBoundedByTheSpeedAndTheRamps) {
  const double found = bound(problem(circle(120, 6), 0.05));
  EXPECT_GT(found, 2 * M_PI * 6 / 20 + 0.15);
  EXPECT_LT(found, 2 * M_PI * 6 / 20 + 0.18);
}

TEST(ProbeBound, WithoutMultipliersItKnowsFullSpeedAndRests) {
  Progress silent;
  const auto quick = [&](const ProbeProblem& p) { return probe_bound(p, silent, 0).value; };
  // With a tube: full speed from end to end; each move from or to a rest is short enough for the speed to decide.
  const ProbeProblem wide = problem({{0, 0}, {90, 0}, {90, 60}}, 0.1);
  EXPECT_NEAR(quick(wide), 150.0 / 20, 1e-6);
  // Without one the head rests at the corner: (384 d/S)^¼ each, of the two moves of 0.02 mm.
  const ProbeProblem narrow = problem({{0, 0}, {0.02, 0}, {0.02, 0.02}}, 0);
  EXPECT_NEAR(quick(narrow), 2 * std::pow(384 * 0.02 / 200000, 0.25), 1e-5);
  for (const ProbeProblem& p : {wide, narrow}) EXPECT_LE(quick(p), bound(p) * (1 + 1e-12));
}

TEST(ProbeBound, FewerMultipliersProveTheRampsOfDensePoints) {
  Progress silent;
  const ProbeProblem p = problem(circle(120, 6), 0.05);
  const double quick = probe_bound(p, silent, 40).value;
  EXPECT_GT(quick, 2 * M_PI * 6 / 20 + 0.1);
  EXPECT_LT(quick, 2 * M_PI * 6 / 20 + 0.18);
}

}  // namespace
}  // namespace bahnwerk
