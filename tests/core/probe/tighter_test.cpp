#include "core/probe/tighter.hpp"

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/spline/spline.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

const std::vector<Vec> hills{{0, 0}, {2, 1}, {5, 1.4}, {7, 0.2}, {9, -1}};

TEST(Tighter, EveryProblemKeepsTheGivenValues) {
  const ProbeProblem p = problem(hills, 0.3);
  const std::vector<ProbeProblem> list = probe::with_tighter(p);
  ASSERT_GT(list.size(), 5u);
  for (const ProbeProblem& q : list) {
    EXPECT_LE(q.speed, p.speed);
    EXPECT_LE(q.tolerance, p.tolerance);
    EXPECT_GT(q.speed, 0);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LE(q.axis(k).acceleration, p.axis(k).acceleration);
      EXPECT_LE(q.axis(k).jerk, p.axis(k).jerk);
      EXPECT_LE(q.axis(k).snap, p.axis(k).snap);
    }
  }
}

TEST(Tighter, TheLimitOfSpeedIsAboveThatOfAStraightFromRestToRest) {
  // 2 (v/a + a/j + j/s) v/2 is the way of speeding up and braking: 30 mm/s need 11 mm and more.
  const ProbeProblem p = problem({{0, 0}, {11, 0}}, 0, 2, 1e6, 200, 4000, 200000);
  EXPECT_GT(probe::unreachable_speed(p), 30);
  EXPECT_LT(probe::unreachable_speed(p), 300);
}

TEST(Tighter, SpeedsThatCannotBeReachedAreOneProblem) {
  SilentProgress silent;
  const double reach = probe::unreachable_speed(problem(hills, 0.3));
  const ProbeProblem a = problem(hills, 0.3, 2, 1.01 * reach), b = problem(hills, 0.3, 2, 60 * reach);
  EXPECT_EQ(plan_arcs(a, silent).duration(), plan_arcs(b, silent).duration());
  EXPECT_EQ(plan_spline(a, silent).duration(), plan_spline(b, silent).duration());
}

}  // namespace
}  // namespace bahnwerk
