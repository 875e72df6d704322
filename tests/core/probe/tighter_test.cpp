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
  std::vector<ProbeProblem> list = probe::slower_problems(p, 2);
  for (ProbeProblem& weaker : probe::weaker_problems(p)) list.push_back(std::move(weaker));
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

TEST(Tighter, SpeedsThatAreTooLowForAKnownDurationAreLeftOut) {
  // The polyline is 10.1 mm long.
  const ProbeProblem p = problem(hills, 0.3);
  for (const double duration : {0.7, 1.0, 4.0})
    for (const ProbeProblem& q : probe::slower_problems(p, duration)) EXPECT_GT(q.speed, 10 / duration);
  EXPECT_GT(probe::slower_problems(p, 4).size(), probe::slower_problems(p, 0.7).size());
}

TEST(Tighter, AQuantityIsScaledUpToItsGivenValue) {
  const ProbeProblem p = problem(hills, 0.3);
  ProbeProblem q = p;
  EXPECT_FALSE(probe::scale_quantity(q, probe::TightenedQuantity::jerk, 1.1, p));
  EXPECT_TRUE(probe::scale_quantity(q, probe::TightenedQuantity::jerk, 0.5, p));
  EXPECT_EQ(q.axis(0).jerk, p.axis(0).jerk / 2);
  EXPECT_EQ(q.axis(1).jerk, p.axis(1).jerk / 2);
  EXPECT_EQ(q.axis(0).snap, p.axis(0).snap);
  EXPECT_TRUE(probe::scale_quantity(q, probe::TightenedQuantity::jerk, 3, p));
  EXPECT_EQ(q.axis(0).jerk, p.axis(0).jerk);
  EXPECT_TRUE(probe::scale_quantity(q, probe::TightenedQuantity::tolerance, 0.5, p));
  EXPECT_EQ(q.tolerance, 0.15);
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
