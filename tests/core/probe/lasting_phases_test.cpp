#include "core/probe/lasting_phases.hpp"

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/straight/stops.hpp"
#include "core/probe/within_limits.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

const std::vector<Vec> corner{{0, 0}, {5, 0}, {5, 5}};

TEST(LastingPhases, LimitsAreLoweredUntilEveryPhaseLasts) {
  const ProbeProblem p = problem(corner, 0.05, 2, 20, 200, 4e9, 1e15), lasting = probe::with_phases_of(1e-3, p);
  EXPECT_EQ(lasting.axis(0).acceleration, 200);
  EXPECT_EQ(lasting.axis(0).jerk, 2e5);
  EXPECT_EQ(lasting.axis(1).snap, 2e8);
  const ProbeProblem slow = problem(corner, 0.05);
  EXPECT_EQ(probe::with_phases_of(1e-3, slow).axis(0).snap, 200000);
}

TEST(LastingPhases, RoundingBlursPhasesOfAMillionthOfTheDuration) {
  const ProbeProblem p = problem(corner, 0.05);  // the jerk is reached within 0.02 s, the acceleration within 0.05 s
  EXPECT_FALSE(probe::phases_may_blur(p, 4000));
  EXPECT_TRUE(probe::phases_may_blur(p, 6000));
}

TEST(LastingPhases, PlansWithoutShortPhasesStay) {
  Progress silent;
  ProgressScope scope(silent, "test");
  const ProbeProblem p = problem(corner, 0.05);
  const ProbeMotion plan = plan_stops(p, silent);
  const ProbeMotion same = probe::with_lasting_phases(
      p, plan,
      [&](const ProbeProblem&) {
        ADD_FAILURE() << "a plan that keeps its limits is planned once";
        return plan;
      },
      scope);
  EXPECT_EQ(same.motion, plan.motion);
}

TEST(LastingPhases, EveryMethodOfPhasesKeepsLimitsThatItReachesWithinItsRounding) {
  // The jerk is reached within 4e-12 s, in the other case the acceleration within 2e-13 s.
  const std::vector<Vec> points{{0, 0}, {5, 0}, {5, 5}, {30, 5.5}, {55, 4.75}, {55.5, 30}};
  struct Limits {
    double jerk, snap;
  };
  for (const Limits limits : {Limits{4000, 1e15}, Limits{1e15, 1e18}})
    for (const double tolerance : {0.0, 0.05}) {
      const ProbeProblem p = problem(points, tolerance, 2, 20, 200, limits.jerk, limits.snap);
      Progress silent;
      const ProbeMotion stops = plan_stops(p, silent), arcs = plan_arcs(p, silent);
      const std::string name = std::to_string(limits.snap) + " " + std::to_string(tolerance);
      expect_right(p, stops, "stops " + name);
      expect_right(p, arcs, "arcs " + name);
      // Phases that last cost a few millionths.
      const ProbeProblem lasting = probe::with_phases_of(1e-4, p);
      EXPECT_LT(stops.duration(), plan_stops(lasting, silent).duration()) << name;
      EXPECT_EQ(stops.duration(), stops_duration(p)) << name;
      EXPECT_LE(arcs.duration(), stops.duration() * (1 + 1e-12)) << name;
    }
}

}  // namespace
}  // namespace bahnwerk
