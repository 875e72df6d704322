#include "core/probe/straight/stops.hpp"

#include "core/base/progress.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

TEST(Stops, EveryCornerIsARestAndARowIsOneStraight) {
  // 6 mm at 20 mm/s and 0.17 s for each of two straights.
  const ProbeProblem p = problem({{1, 1}, {3, 1}, {7, 1}, {7, 7}}, 0.05);
  Progress silent;
  const ProbeMotion plan = plan_stops(p, silent);
  expect_right(p, plan);
  EXPECT_NEAR(plan.duration(), 2 * (6.0 / 20 + 0.17), 1e-12);
  EXPECT_NEAR(stops_duration(p), plan.duration(), 1e-12);
  std::size_t rests = 0;
  for (const ProbePhase& phase : plan.phases) {
    if (phase.kind != ProbePhaseKind::rest) continue;
    ++rests;
    EXPECT_EQ(phase.point, 2u);
    EXPECT_EQ(phase.begin, phase.end);
  }
  EXPECT_EQ(rests, 1u);
}

TEST(Stops, PointsInSpaceArePassedAtTheirTimes) {
  const ProbeProblem p = problem({{0, 0, 0}, {12, 3, 1}, {20, 14, 9}, {9, 20, 22}}, 0, 3);
  Progress silent;
  const ProbeMotion plan = plan_stops(p, silent);
  expect_right(p, plan);
  ASSERT_EQ(plan.times.size(), 4u);
  EXPECT_LT(plan.times[1], plan.times[2]);
}

}  // namespace
}  // namespace bahnwerk
