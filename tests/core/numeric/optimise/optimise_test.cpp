#include "core/numeric/optimise/optimise.hpp"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <numbers>

#include "tests/core/numeric/optimise/gradient_check.hpp"
#include "tests/core/numeric/optimise/problems.hpp"
#include "tests/core/numeric/optimise/solving.hpp"

namespace bahnwerk {
namespace {

using test::expect_minimum;
using test::infinity;
using test::Method;
using test::nan;
using test::parabola;
using test::solve;
using test::Status;

// The gradients of the test problems themselves.
TEST(GradientCheck, HoldsForTheTestProblems) {
  for (const KnownProblem& k : {tutorial(), rosenbrock(), hs35(), hs43(), hs71(), hs100(), banded_quadratic(10)})
    EXPECT_LT(gradient_error(k.problem, k.start), 1e-7);
}

TEST(GradientCheck, FindsAWrongOne) {
  KnownProblem k = hs71();
  k.problem.equality.evaluate = [](Point x, Values c, Values j) {
    c[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - 40;
    fill(j, {2 * x[0], 2 * x[1], 2 * x[2], x[3]});
  };
  EXPECT_GT(gradient_error(k.problem, k.start), 0.1);
}

// Loose step tolerances, too: NLopt's slsqp alone ends at 2.18 instead of 0.54 in the tutorial for 1e-2.
TEST(Minimise, KnownMinimaBySlsqpWhateverTheStepTolerance) {
  for (const double step : {1e-2, 1e-4, 1e-6, 1e-9, 1e-12}) {
    OptimisationOptions options;
    options.step_tolerance = step;
    for (const KnownProblem& k : {tutorial(), rosenbrock(), hs35(), hs43(), hs71(), hs100()})
      expect_minimum(k, solve(k.problem, k.start, options), 2e-7, 1e-4);
  }
}

TEST(Minimise, KnownMinimaByMma) {
  OptimisationOptions options;
  options.method = Method::mma;
  for (const KnownProblem& k : {tutorial(), hs35(), hs43(), hs100()})
    expect_minimum(k, solve(k.problem, k.start, options), 2e-7, 1e-4);
}

TEST(Minimise, KnownMinimaByCobyla) {
  OptimisationOptions options;
  options.method = Method::cobyla;
  options.step_tolerance = 1e-5;
  for (const KnownProblem& k : {tutorial(), hs35(), hs43(), hs71(), hs100()}) {
    const OptimisationResult found = solve(k.problem, k.start, options);
    EXPECT_EQ(found.status, Status::search_ended);
    EXPECT_NEAR(found.objective, k.minimum, 1e-5);
    EXPECT_LE(found.violation, 1e-8);
    EXPECT_TRUE(std::isnan(found.kkt_residual));
  }
}

TEST(Minimise, GlobalSearches) {
  OptimisationProblem p;  // Rastrigin's function: 10² local minima in the box, 0 at (0.3, 0.3)
  p.dimension = 2;
  p.lower = {-5, -5};
  p.upper = {5, 5};
  p.objective = [](Point x, Values) {
    double sum = 0;
    for (const double v : x) sum += (v - 0.3) * (v - 0.3) + 10 * (1 - std::cos(2 * std::numbers::pi * (v - 0.3)));
    return sum;
  };
  for (const Method method : {Method::isres, Method::direct_l}) {
    OptimisationOptions options;
    options.method = method;
    EXPECT_LT(solve(p, {4, 4}, options).objective, 1e-4);
  }
}

TEST(Minimise, ConvexQuadraticOf200Variables) {
  const KnownProblem k = banded_quadratic(200);
  expect_minimum(k, solve(k.problem, k.start), 1e-7, 2e-6);
}

TEST(Minimise, ScalesOfVariablesRowsAndObjective) {
  KnownProblem k = hs71();
  const OptimisationProblem inner = k.problem;
  const std::array<double, 4> unit{1e-6, 1e3, 1, 1e5};  // x = unit · y
  OptimisationProblem p = inner;
  const auto point = [unit](Point x) {
    std::vector<double> y(4);
    for (std::size_t j = 0; j < 4; ++j) y[j] = x[j] / unit[j];
    return y;
  };
  p.objective = [=](Point x, Values g) {
    const double f = 1e-4 * inner.objective(point(x), g);
    for (std::size_t j = 0; j < g.size(); ++j) g[j] *= 1e-4 / unit[j];
    return f;
  };
  const auto rows = [=](const Constraints& from, double factor) {
    return Constraints{1,
                       [=](Point x, Values c, Values j) {
                         from.evaluate(point(x), c, j);
                         c[0] *= factor;
                         for (std::size_t i = 0; i < j.size(); ++i) j[i] *= factor / unit[i];
                       },
                       {factor}};
  };
  p.inequality = rows(inner.inequality, 1e7);
  p.equality = rows(inner.equality, 1e-5);
  p.scale.assign(unit.begin(), unit.end());
  p.objective_scale = 1e-4;
  for (std::size_t j = 0; j < 4; ++j) {
    p.lower[j] *= unit[j];
    p.upper[j] *= unit[j];
    k.start[j] *= unit[j];
  }
  OptimisationResult found = solve(p, k.start);
  EXPECT_NEAR(found.objective, 1e-4 * k.minimum, 1e-11);
  found.objective *= 1e4;
  for (std::size_t j = 0; j < 4; ++j) found.x[j] /= unit[j];
  expect_minimum(k, found, 1e-7, 1e-6);
}

TEST(Minimise, VariablesThatAreFixedAndBoundsThatAreActive) {
  OptimisationProblem p = parabola(3, 2);
  p.lower = {0, -infinity, 0.5};
  p.upper = {1, infinity, 0.5};
  for (const Method method : {Method::slsqp, Method::mma}) {
    OptimisationOptions options;
    options.method = method;
    expect_minimum({p, {}, 3.25, {1, 2, 0.5}}, solve(p, {0.5, 0, 0.5}, options), 1e-9, 1e-6);
  }
}

TEST(Minimise, StartsOutsideTheBoundsAndNeverLeavesThem) {
  for (const Method method : {Method::slsqp, Method::mma, Method::cobyla, Method::isres, Method::direct_l}) {
    OptimisationProblem p = parabola(2, 3);
    p.lower = {-1, -1};
    p.upper = {1.1, 4};
    p.scale = {0.7, 0.3};
    const auto f = p.objective;
    p.objective = [&](Point x, Values g) {
      EXPECT_TRUE(x[0] >= -1 && x[0] <= 1.1 && x[1] >= -1 && x[1] <= 4);
      return f(x, g);
    };
    OptimisationOptions options;
    options.method = method;
    EXPECT_NEAR(solve(p, {-20, 20}, options).objective, 1.9 * 1.9, 1e-4);
  }
}

TEST(Minimise, TurnsBackFromUndefinedPoints) {
  for (const double outside : {nan, infinity, -infinity}) {
    OptimisationProblem p;  // x − ln x with a bad first step from 50 and values for x > 0 alone
    p.dimension = 1;
    p.objective = [=](Point x, Values g) {
      fill(g, {1 - 1 / x[0]});
      return x[0] > 0 ? x[0] - std::log(x[0]) : outside;
    };
    for (const Method method : {Method::slsqp, Method::mma, Method::cobyla}) {
      OptimisationOptions options;
      options.method = method;
      EXPECT_NEAR(solve(p, {50}, options).x.at(0), 1, 1e-3);
      EXPECT_NEAR(solve(p, {-0.001}, options).x.at(0), 1, 1e-3);  // found near the start
    }
    p.lower = {-10};
    p.upper = {10};
    for (const Method method : {Method::isres, Method::direct_l}) {
      OptimisationOptions options;
      options.method = method;
      EXPECT_NEAR(solve(p, {5}, options).x.at(0), 1, 1e-3);
    }
  }
}

TEST(Minimise, UndefinedEverywhere) {
  OptimisationProblem p = parabola(2, 0);
  p.objective = [](Point, Values) { return nan; };
  const OptimisationResult found = solve(p, {1, 1});
  EXPECT_EQ(found.status, Status::undefined);
  EXPECT_TRUE(std::isnan(found.objective));
}

TEST(Minimise, GradientsThatAreNotSet) {
  OptimisationProblem p = parabola(2, 0);
  p.objective = [](Point x, Values) { return x[0] * x[0] + x[1] * x[1]; };
  const OptimisationResult found = solve(p, {1, 1});
  EXPECT_EQ(found.status, Status::undefined);
  EXPECT_TRUE(std::isnan(found.kkt_residual));
}

TEST(Minimise, AWrongGradientIsNeverConverged) {
  OptimisationProblem p = parabola(2, 0);
  p.objective = [](Point x, Values g) {
    fill(g, {2 * x[0] + 1, 2 * x[1] - 1});
    return x[0] * x[0] + x[1] * x[1];
  };
  EXPECT_NE(solve(p, {1, 1}).status, Status::converged);
}

}  // namespace
}  // namespace bahnwerk
