#include "core/probe/arcs/arcs.hpp"

#include "core/base/progress.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

ProbeMotion arcs(const ProbeProblem& problem) {
  Progress silent;
  return plan_arcs(problem, silent);
}

TEST(Arcs, TwoPointsAreTheProfileOfFifteenPhases) {
  const ProbeProblem axis = problem({{0, 0, 0}, {0, 0, 80}}, 0.1, 3);
  const ProbeMotion plan = arcs(axis);
  EXPECT_NEAR(plan.duration(), 80.0 / 20 + 20.0 / 200 + 200.0 / 4000 + 4000.0 / 200000, 1e-12);
  EXPECT_EQ(plan.motion->pieces(), 15u);
  expect_right(axis, plan);
}

TEST(Arcs, PointsInARowArePassedAsOneStraight) {
  const ProbeProblem p = problem({{-40, 0, 0}, {-20, 0, 0}, {-20, 0, 0}, {10, 0, 0}, {40, 0, 0}}, 0, 3);
  const ProbeMotion plan = arcs(p);
  EXPECT_NEAR(plan.duration(), 4.17, 1e-12);
  ASSERT_EQ(plan.times.size(), 4u);
  EXPECT_NEAR(plan.times[1], 0.17 + 18.3 / 20, 1e-12);
  EXPECT_NEAR(plan.times[2], 0.17 + 48.3 / 20, 1e-12);
  expect_right(p, plan);
}

TEST(Arcs, WithoutToleranceTheHeadRestsAtCorners) {
  const ProbeProblem p = problem({{0, 0}, {5, 0}, {5, 5}}, 0);
  const ProbeMotion plan = arcs(p);
  EXPECT_NEAR(plan.duration(), 0.84, 1e-12);
  expect_right(p, plan);
}

TEST(Arcs, ACornerInTheTubeIsQuickerThanARest) {
  const ProbeProblem p = problem({{0, 0}, {5, 0}, {5, 5}}, 0.05);
  const ProbeMotion plan = arcs(p);
  EXPECT_LT(plan.duration(), 0.8383);
  expect_right(p, plan);
}

TEST(Arcs, AReversalIsATurnEvenWithoutTube) {
  const ProbeProblem p = problem({{0, 0}, {50, 0}, {0, 0}}, 0);
  const ProbeMotion plan = arcs(p);
  EXPECT_LT(plan.duration(), 5.3);
  expect_right(p, plan);
}

TEST(Arcs, TurnsInSpace) {
  const ProbeProblem p = problem({{0, 0, 0}, {12, 3, 1}, {20, 14, 9}, {9, 20, 22}, {-3, 10, 30}}, 0.4, 3);
  const ProbeMotion plan = arcs(p);
  EXPECT_LT(plan.duration(), stops_duration(p));
  expect_right(p, plan);
  Progress silent;
  expect_right(p, plan_stops(p, silent));
  EXPECT_NEAR(plan_stops(p, silent).duration(), stops_duration(p), 1e-12);
}

TEST(Arcs, ACircleOfPointsIsPassedWithoutRests) {
  const ProbeProblem p = problem(circle(60, 10), 0.05);
  const ProbeMotion plan = arcs(p);
  EXPECT_LT(plan.duration(), 6);
  expect_right(p, plan);
}

TEST(Arcs, ASpeedThatCannotBeReachedChangesNothing) {
  // 70 mm at 0.4 mm/s⁴: some 20 mm/s are all that an edge admits.
  const std::vector<Vec> points{{0, 0, 0}, {56, 42.01, 0}, {112.01, 84, 0.01}, {168, 126, 0}};
  const auto duration = [&](double speed) {
    Progress silent;
    return plan_arcs(problem(points, 30, 3, speed, 3, 1, 0.4), silent).duration();
  };
  const double least = duration(80);
  for (const double speed : {95.0, 140.0, 700.0}) EXPECT_NEAR(duration(speed), least, 1e-9 * least) << speed;
  EXPECT_LT(least, 0.55 * stops_duration(problem(points, 30, 3, 80, 3, 1, 0.4)));
}

}  // namespace
}  // namespace bahnwerk
