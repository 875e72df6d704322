#include "core/probe/within_limits.hpp"

#include "core/base/progress.hpp"
#include "core/probe/optimal/optimal.hpp"
#include "core/probe/straight/stops.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

TEST(WithinLimits, MotionsThatKeepAllLimitsStay) {
  Progress silent;
  ProgressScope scope(silent, "test");
  const ProbeProblem p = problem({{0, 0}, {30, 0}, {30, 20}}, 0);
  const ProbeMotion stops = plan_stops(p, silent);
  EXPECT_NEAR(probe::needed_slowing(p, stops, 1, scope), 1, 1e-10);
  EXPECT_EQ(probe::within_limits(p, stops, scope).duration(), stops.duration());
}

TEST(WithinLimits, AMotionThatIsTooQuickIsSlowedByWhatItExceeds) {
  Progress silent;
  ProgressScope scope(silent, "test");
  const ProbeProblem p = problem({{0, 0}, {30, 0}, {30, 20}}, 0);
  const ProbeMotion quick = slowed(plan_stops(p, silent), 1 / 1.01);
  EXPECT_NEAR(probe::needed_slowing(p, quick, 1, scope), 1.01, 1e-9);
  const ProbeMotion right = probe::within_limits(p, quick, scope);
  expect_right(p, right);
  EXPECT_LT(right.duration(), 1.03 * plan_stops(p, silent).duration());
}

TEST(WithinLimits, PiecesThatAreShortBesideTheirCoordinatesKeepLimits) {
  Progress silent;
  const RandomSet set(53);
  const ProbeMotion plan = plan_optimal(set.problem, silent);
  EXPECT_LT(plan.duration(), 0.95 * stops_duration(set.problem));
  expect_right(set.problem, plan);
}

}  // namespace
}  // namespace bahnwerk
