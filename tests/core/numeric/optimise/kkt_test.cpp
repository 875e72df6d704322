#include "core/numeric/optimise/kkt.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/numeric/optimise/problems.hpp"

namespace bahnwerk {
namespace {

double residual(const OptimisationProblem& problem, const std::vector<double>& x) {
  const OptimisationOptions options;
  Progress silent;
  OptimisationEvaluator evaluator(problem, options, silent);
  return kkt_residual(evaluator, evaluator.at(evaluator.scaled(x), true));
}

TEST(KktResidual, VanishesAtMinimaOnly) {
  for (const KnownProblem& k : {tutorial(), rosenbrock(), hs35(), hs43(), banded_quadratic(40)}) {
    EXPECT_LT(residual(k.problem, k.x), 1e-12);
    EXPECT_GT(residual(k.problem, k.start), 0.1);
  }
  EXPECT_LT(residual(hs71().problem, hs71().x), 1e-7);  // known to 8 digits
}

TEST(KktResidual, GrowsWithTheDistanceFromTheMinimum) {
  for (const double distance : {1e-8, 1e-6, 1e-4}) {
    KnownProblem k = hs35();
    k.x[0] -= distance;
    const double found = residual(k.problem, k.x);
    EXPECT_GT(found, 0.05 * distance);
    EXPECT_LT(found, 10 * distance);
  }
}

TEST(KktResidual, MultipliersOfTheWrongSignDoNotCount) {
  KnownProblem k = hs35();
  k.problem.inequality.evaluate = [](Point x, Values c, Values j) {  // the other side of the row is feasible
    c[0] = 3 - x[0] - x[1] - 2 * x[2];
    fill(j, {-1, -1, -2});
  };
  EXPECT_GT(residual(k.problem, k.x), 0.1);
}

}  // namespace
}  // namespace bahnwerk
