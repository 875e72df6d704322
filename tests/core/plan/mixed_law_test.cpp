/// Classical laws mixed with optimal splines, whole plans: the verifier shares nothing with the solvers.
#include <gtest/gtest.h>

#include <optional>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/classical/classical_sections.hpp"
#include "core/plan/motion_law/law_plan.hpp"
#include "tests/core/cam/problems.hpp"
#include "tests/core/cam/random_laws.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

using namespace cam::testing_problems;

LawPlan planned(const cam::MotionLawProblem& problem) {
  Progress progress;
  return plan_motion_law(problem, {std::nullopt, 100}, progress);
}
std::optional<LawPlan> planned_where_possible(const cam::MotionLawProblem& problem) {
  try {
    return planned(problem);
  } catch (const InvalidInput&) {
  } catch (const Infeasible&) {
  }
  return std::nullopt;
}
void expect_verified(const LawPlan& plan, int number) {
  for (const Check& check : plan.verification.checks)
    EXPECT_TRUE(check.passed) << number << ": " << check.subject << ' ' << check.value << " > " << check.limit;
}

/// Some sections of a random problem get a classical law, from rest or in motion.
cam::MotionLawProblem random_mixture(Random& random) {
  cam::MotionLawProblem out = cam::testing::random_law(random, 3 + random.below(4));
  bool any = false;
  for (std::size_t s = 0; s < out.sections(); ++s) {
    if (!random.chance(0.4) && !(s + 1 == out.sections() && !any)) continue;
    any = true;
    out.points[s].law = cam::classical_laws[random.below(std::size(cam::classical_laws))].value;
    if (out.points[s].law != cam::ClassicalLaw::straight && random.chance(0.3))
      out.points[s].inflection = random.uniform(0.35, 0.65);
    out.points[s].section = {};
    for (const std::size_t p : {s, out.end_point(s)}) {
      const cam::Range position = out.points[p].value(0);
      const double middle = (position.min + position.max) / 2;
      out.points[p].values = {number(middle)};
      if (random.chance(0.2) && out.points[s].law != cam::ClassicalLaw::straight)
        out.points[p].values.push_back(number(random.uniform(-150, 150)));
    }
  }
  // Two classical laws that meet share the velocity alone.
  for (std::size_t s = 0; s < out.sections(); ++s)
    if (out.points[s].law && out.points[out.end_point(s)].law) out.points[out.end_point(s)].continuity = 1;
  return out;
}

TEST(MixedLaw, RandomMixturesAreVerifiedAndNoWorseThanTheActiveSet) {
  int count = 0, compared = 0;
  for (int number = 0; number < testing::cases(16); ++number) {
    Random random(static_cast<std::uint64_t>(number) + 77);
    cam::MotionLawProblem problem = random_mixture(random);
    problem.method = cam::LawMethod::active_set;
    const auto active = planned_where_possible(problem);
    problem.method = cam::LawMethod::optimal;
    int degree = 7;
    if (active)
      for (const int each : active->solution.degrees) degree = std::max(degree, each);
    problem.degree = degree;
    const auto optimal = planned_where_possible(problem);
    EXPECT_TRUE(optimal || !active) << number;
    if (!optimal) continue;
    ++count;
    expect_verified(*optimal, number);
    const double best = optimal->solution.value.objective;
    EXPECT_LE(optimal->lower, best) << number;
    // J is not less than what the peaks of each classical section are worth.
    for (std::size_t s = 0; s < problem.sections(); ++s) {
      if (!problem.points[s].law) continue;
      double worth = 0;
      for (int r = 1; r < cam::limited_orders; ++r) {
        double peak = 0;
        for (std::size_t i = 0; i < optimal->solution.law.pieces(); ++i)
          if (optimal->solution.law.piece(i).section == s)
            peak = std::max(peak, optimal->solution.law.peak(r, i).value);
        worth += problem.objective.weight[static_cast<std::size_t>(r)] * peak;
      }
      EXPECT_GE(best, worth * (1 - 1e-12)) << number;
    }
    if (!active) continue;
    ++compared;
    EXPECT_LE(best, active->solution.value.objective * (1 + 1e-8)) << number;
    EXPECT_LE(optimal->lower, active->solution.value.objective * (1 + 1e-9)) << number;
  }
  EXPECT_GE(count, testing::cases(16) / 2);
  EXPECT_GE(compared, testing::cases(16) / 4);
}

/// A mode at rest at the begin of a modified sine rests again where the spline behind it ends.
TEST(MixedLaw, TheSplineTakesTheVibrationOutThatAClassicalSectionLeaves) {
  cam::MotionLawProblem p = problem(0.3, false, {rest(0, 0), point(0.12, 2, {number(20)}), rest(0.3, 45)});
  p.method = cam::LawMethod::optimal;
  p.objective.weight = {0, 1, 0.02, 0.0005};
  p.points[0].law = cam::ClassicalLaw::modified_sine;
  p.degree = 7;
  p.pieces = 4;
  p.vibration = {{11, 0.02}};
  p.points[0].still = p.points[2].still = true;
  const LawPlan plan = planned(p);
  expect_verified(plan, 0);
  EXPECT_TRUE(plan.verification.passed);
}

/// Angles may be in ranges, that at the end of a classical section, too.
TEST(MixedLaw, AnglesMayBeChosen) {
  cam::MotionLawProblem p = problem(360, true,
                                    {point(0, 2, {number(0)}), point(90, 2, {number(25)}), point(140, 2, {number(25)}),
                                     point(200, 2, {{9, 11}}), point(280, 2, {number(0)})});
  p.cycle_duration = 0.36;
  p.objective.weight = {0, 1, 0.02, 0.0005};
  p.method = cam::LawMethod::optimal;
  p.points[0].law = cam::ClassicalLaw::polynomial_345;
  p.points[1].law = cam::ClassicalLaw::straight;
  p.degree = 7;
  const double fixed = planned(p).solution.value.objective;
  p.points[1].at = {80, 110};
  p.points[3].at = {170, 230};
  p.points[4].at = {250, 330};
  const LawPlan chosen = planned(p);
  expect_verified(chosen, 0);
  EXPECT_LE(chosen.solution.value.objective, fixed * (1 + 1e-8));
  EXPECT_LE(chosen.lower, chosen.solution.value.objective);
}

/// Ranges of the other points and limits of the other sections hold beside a classical section.
TEST(MixedLaw, RangesAndLimitsHoldBesideAClassicalSection) {
  cam::MotionLawProblem p = problem(
      0.4, false, {rest(0, 0), point(0.1, 2, {number(12), number(180)}), point(0.25, 3, {{30, 34}}), rest(0.4, 40)});
  p.method = cam::LawMethod::optimal;
  p.objective.weight = {0, 1, 0.02, 0.0005};
  p.points[0].law = cam::ClassicalLaw::modified_trapezoid;
  p.points[1].section[0] = {12, 34};
  p.points[2].section[1].min = 0;
  const LawPlan plan = planned(p);  // the smallest degree within 1 % of the bound
  expect_verified(plan, 0);
  EXPECT_LE(plan.solution.value.objective, 1.0101 * plan.lower);
}

/// A law without jerk and velocity between its points is worth nothing to J: optimal is not worse by rounding.
TEST(MixedLaw, WhereTheActiveSetReachesZeroOptimalDoes) {
  cam::MotionLawProblem p =
      problem(1, false, {point(0, 2, {number(0)}), point(0.4, 2, {{3, 5}}), point(1, 2, {number(10)})});
  p.objective.weight = {0, 0, 1, 0.1};
  p.method = cam::LawMethod::active_set;
  const LawPlan active = planned(p);
  p.method = cam::LawMethod::optimal;
  p.degree = 5;
  const LawPlan optimal = planned(p);
  EXPECT_LE(optimal.solution.value.objective, active.solution.value.objective);
  EXPECT_LE(optimal.lower, optimal.solution.value.objective);
  expect_verified(optimal, 0);
}

}  // namespace
}  // namespace bahnwerk
