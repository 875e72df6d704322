#include "core/probe/reachable_speed.hpp"

#include "core/base/progress.hpp"
#include "core/probe/arcs/arcs.hpp"
#include "core/probe/spline/spline.hpp"
#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

const std::vector<Vec> hills{{0, 0}, {2, 1}, {5, 1.4}, {7, 0.2}, {9, -1}};

TEST(ReachableSpeed, TheLimitIsAboveThatOfAStraightFromRestToRest) {
  // 2 (v/a + a/j + j/s) v/2 is the way of speeding up and braking: 30 mm/s need 11 mm and more.
  const ProbeProblem p = problem({{0, 0}, {11, 0}}, 0, 2, 1e6, 200, 4000, 200000);
  EXPECT_GT(probe::unreachable_speed(p), 30);
  EXPECT_LT(probe::unreachable_speed(p), 300);
}

TEST(ReachableSpeed, SpeedsThatCannotBeReachedAreOneProblem) {
  Progress silent;
  const double reach = probe::unreachable_speed(problem(hills, 0.3));
  const ProbeProblem a = problem(hills, 0.3, 2, 1.01 * reach), b = problem(hills, 0.3, 2, 60 * reach);
  EXPECT_EQ(plan_arcs(a, silent).duration(), plan_arcs(b, silent).duration());
  EXPECT_EQ(plan_spline(a, silent).duration(), plan_spline(b, silent).duration());
}

}  // namespace
}  // namespace bahnwerk
