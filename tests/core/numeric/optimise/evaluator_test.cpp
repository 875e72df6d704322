#include "core/numeric/optimise/evaluator.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/numeric/optimise/problems.hpp"

namespace bahnwerk {
namespace {

TEST(OptimisationEvaluator, RunsTheCallbacksOncePerPoint) {
  const KnownProblem k = hs71();
  const OptimisationOptions options;
  Progress silent;
  OptimisationEvaluator evaluator(k.problem, options, silent);
  const std::vector<double> a{1, 5, 5, 1}, b{1, 4, 4, 1};
  evaluator.at(a, false);
  evaluator.at(a, false);
  EXPECT_EQ(evaluator.evaluations(), 1);
  evaluator.at(a, true);  // the gradients are new
  evaluator.at(a, false);
  EXPECT_EQ(evaluator.evaluations(), 2);
  evaluator.at(b, true);
  EXPECT_EQ(evaluator.evaluations(), 3);
  EXPECT_EQ(evaluator.left(), options.max_evaluations - 3);
}

TEST(OptimisationEvaluator, KeepsTheBestFeasiblePointElseTheLeastViolation) {
  const KnownProblem k = hs35();  // x₀ + x₁ + 2x₂ ≤ 3
  const OptimisationOptions options;
  Progress silent;
  OptimisationEvaluator evaluator(k.problem, options, silent);
  const auto best_after = [&](std::vector<double> z) {
    evaluator.at(z, false);
    return evaluator.best().x;
  };
  const std::vector<double> far{9, 9, 9}, near{2, 2, 0}, zero{0, 0, 0}, minimum{4.0 / 3, 7.0 / 9, 4.0 / 9};
  EXPECT_EQ(best_after(far), far);
  EXPECT_EQ(best_after(near), near);
  EXPECT_EQ(best_after(far), near);
  EXPECT_EQ(best_after(zero), zero);
  EXPECT_EQ(best_after(near), zero);
  EXPECT_EQ(best_after(minimum), minimum);
  EXPECT_EQ(best_after(zero), minimum);
}

}  // namespace
}  // namespace bahnwerk
