#include "core/probe/optimal/passing.hpp"

#include "core/probe/straight/stops.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

/// The straight from the first point to the last one.
ProbeMotion straight(const ProbeProblem& p) {
  Progress silent;
  ProbeProblem ends = p;
  ends.given = {p.given.front(), p.given.back()};
  merge_points(ends);
  return plan_stops(ends, silent);
}

TEST(Passing, PointsOutOfOrderWithinTheirToleranceArePassedInOrder) {
  ProbeProblem p = problem({{0, 0}, {2, 8e-4}, {1.9995, -5e-4}, {4, 9e-4}, {6, 0}}, 0.01);
  p.point_tolerance = 1e-3;
  merge_points(p);
  ProbeMotion motion = straight(p);
  const Passing passing = pass_points(p, *motion.motion, {0, 4}, {0, motion.duration()});
  EXPECT_TRUE(passing.open.empty());
  motion.times = passing.times;
  expect_right(p, motion);
}

TEST(Passing, PointsOutOfOrderAcrossAChosenPointArePassedInOrder) {
  ProbeProblem p = problem({{0, 0}, {2, 4e-4}, {3.0004, 8e-4}, {3, 0}, {2.9996, -8e-4}, {4, 9e-4}, {6, 0}}, 0.01);
  p.point_tolerance = 1e-3;
  merge_points(p);
  ProbeMotion motion = straight(p);
  const double half = motion.duration() / 2;
  const Passing passing = pass_points(p, *motion.motion, {0, 3, 6}, {0, half, 2 * half});
  EXPECT_TRUE(passing.open.empty());
  motion.times = passing.times;
  expect_right(p, motion);
}

TEST(Passing, APointTooFarAwayOrATubeThatIsLeftIsFound) {
  ProbeProblem p = problem({{0, 0}, {1, 0}, {2, 2e-3}, {6, 0}}, 0.01);
  p.point_tolerance = 1e-3;
  merge_points(p);
  const ProbeMotion motion = straight(p);
  EXPECT_EQ(pass_points(p, *motion.motion, {0, 3}, {0, motion.duration()}).open, (std::vector<std::size_t>{0}));
  p.point_tolerance = 3e-3;
  EXPECT_TRUE(pass_points(p, *motion.motion, {0, 3}, {0, motion.duration()}).open.empty());
  p.tolerance = 1e-3;
  EXPECT_EQ(pass_points(p, *motion.motion, {0, 3}, {0, motion.duration()}).open, (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace bahnwerk
