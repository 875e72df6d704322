/// What every motion law has to keep, on random problems: 1000 of them with BAHNWERK_TEST_CASES=50. The verifier, which
/// shares nothing with the solvers, looks at the law between its rows, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/plan/motion_law/law_plan.hpp"
#include "tests/core/cam/random_laws.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

std::optional<LawPlan> planned(const cam::MotionLawProblem& problem) {
  Progress progress;
  try {
    return plan_motion_law(problem, {std::nullopt, 100}, progress);
  } catch (const InvalidInput&) {  // values that contradict each other, a limit that cannot hold
  } catch (const Infeasible&) {
  }
  return std::nullopt;
}

/// How far J is proven: both laws are between their lower bound and their J.
double proven_to(const LawPlan& plan) {
  const double objective = plan.solution.value.objective;
  return (objective - plan.solution.lower.value_or(objective)) / objective;
}

/// The 4th of each 20 problems has up to 50 points.
cam::MotionLawProblem problem_of(int number) {
  Random random(static_cast<std::uint64_t>(number) + 1000003);
  const std::size_t points = number % 20 == 3 ? 9 + random.below(42) : 2 + random.below(7);
  return cam::testing::random_law(random, points);
}

TEST(LawProperty, RandomProblemsAreProvenAndScale) {
  int planned_count = 0, proven = 0, compared = 0;
  const int count = testing::cases(20);
  for (int number = 0; number < count; ++number) {
    cam::MotionLawProblem problem = problem_of(number);
    problem.method = cam::LawMethod::active_set;
    const auto active = planned(problem);
    problem.method = cam::LawMethod::optimal;
    problem.degree = std::max(5, active ? static_cast<int>(active->solution.law.max_degree()) : 5);
    const auto optimal = planned(problem);
    const auto passes = [&](const LawPlan& plan, const char* method) {
      for (const Check& check : plan.verification.checks)
        EXPECT_TRUE(check.passed) << number << ' ' << method << ": " << check.subject << ' ' << check.value << " > "
                                  << check.limit << " at " << check.at;
      EXPECT_LE(plan.lower, plan.solution.value.objective * (1 + 1e-9)) << number << ' ' << method;
    };
    if (active) passes(*active, "active_set");
    ASSERT_TRUE(optimal || !active) << number << ": the law of active_set is one of these splines";
    if (!optimal) continue;
    ++planned_count;
    passes(*optimal, "optimal");
    const double best = optimal->solution.value.objective;
    proven += proven_to(*optimal) < 1e-7;
    EXPECT_LE(proven_to(*optimal), 1e-4) << number;
    if (active) {
      EXPECT_LE(best, active->solution.value.objective * (1 + 1e-8)) << number;
      EXPECT_LE(active->lower, best * (1 + 1e-9)) << number;
      ++compared;
    }
    if (number % 4 != 0) continue;
    const double stroke = 0.37, time = number % 8 == 0 ? 12.3 : 0.041;
    const auto other = planned(cam::testing::scaled(problem, time, stroke));
    ASSERT_TRUE(other) << number;
    passes(*other, "scaled");
    const double slack = 1e-8 + proven_to(*optimal) + proven_to(*other);
    EXPECT_NEAR(other->solution.value.objective / stroke / best, 1, slack) << number;
    EXPECT_NEAR(other->lower / stroke / optimal->lower, 1, 1e-4) << number;
    if (!active) continue;
    cam::MotionLawProblem same = cam::testing::scaled(problem, time, stroke);
    same.method = cam::LawMethod::active_set;
    const auto scaled = planned(same);
    ASSERT_TRUE(scaled) << number;
    EXPECT_EQ(scaled->solution.degrees, active->solution.degrees) << number;
    EXPECT_NEAR(scaled->solution.value.objective / stroke, active->solution.value.objective,
                1e-9 * active->solution.value.objective)
        << number;
  }
  EXPECT_GE(planned_count, count * 9 / 10);
  EXPECT_GE(proven, planned_count * 97 / 100);
  EXPECT_GE(compared, count / 2);
}

}  // namespace
}  // namespace bahnwerk
