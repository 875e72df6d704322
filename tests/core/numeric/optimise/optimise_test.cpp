#include "core/numeric/optimise/optimise.hpp"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "core/base/errors.hpp"
#include "tests/core/numeric/optimise/gradient_check.hpp"
#include "tests/core/numeric/optimise/problems.hpp"

namespace bahnwerk {
namespace {

using Method = OptimisationMethod;
using Status = OptimisationStatus;
constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

OptimisationResult solve(const OptimisationProblem& problem, const std::vector<double>& start,
                         OptimisationOptions options = {}) {
  SilentProgress silent;
  return minimise(problem, start, options, silent);
}

void expect_minimum(const KnownProblem& known, const OptimisationResult& found, double f_tolerance,
                    double x_tolerance) {
  EXPECT_EQ(found.status, Status::converged);
  EXPECT_NEAR(found.objective, known.minimum, f_tolerance);
  EXPECT_LE(found.violation, 1e-8);
  EXPECT_LE(found.kkt_residual, 1e-6);
  ASSERT_EQ(found.x.size(), known.problem.dimension);
  for (std::size_t j = 0; j < known.x.size(); ++j) EXPECT_NEAR(found.x[j], known.x[j], x_tolerance) << j;
}

OptimisationProblem parabola(std::size_t n, double at) {
  OptimisationProblem p;
  p.dimension = n;
  p.objective = [at](Point x, Values g) {
    double sum = 0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (!g.empty()) g[j] = 2 * (x[j] - at);
      sum += (x[j] - at) * (x[j] - at);
    }
    return sum;
  };
  return p;
}

// The gradients of the test problems themselves.
TEST(GradientCheck, OfTheTestProblems) {
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

TEST(Minimise, ZeroDimension) {
  OptimisationProblem p;
  p.objective = [](Point, Values) { return 7.0; };
  EXPECT_EQ(solve(p, {}).status, Status::converged);
  EXPECT_EQ(solve(p, {}).objective, 7);
  p.inequality = {1, [](Point, Values c, Values) { c[0] = 2; }, {}};
  const OptimisationResult found = solve(p, {});
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_EQ(found.violation, 2);
}

TEST(Minimise, ContradictoryBounds) {
  OptimisationProblem p = parabola(2, 0);
  p.lower = {0, 3};
  p.upper = {1, 1};
  const OptimisationResult found = solve(p, {0.5, 0});
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_EQ(found.violation, 1);
  EXPECT_THAT(found.x, testing::ElementsAre(0.5, 2));
}

TEST(Minimise, ContradictoryConstraintsGiveTheLeastViolation) {
  OptimisationProblem p = parabola(2, 0);  // x₀² + x₁² ≤ 1 and x₀ ≥ 3: least largest violation where x² − 1 = 3 − x
  p.inequality = {2,
                  [](Point x, Values c, Values j) {
                    c[0] = x[0] * x[0] + x[1] * x[1] - 1;
                    c[1] = 3 - x[0];
                    fill(j, {2 * x[0], 2 * x[1], -1, 0});
                  },
                  {}};
  const double x = (std::sqrt(17.0) - 1) / 2;
  for (const Method method : {Method::slsqp, Method::mma, Method::cobyla}) {
    OptimisationOptions options;
    options.method = method;
    const OptimisationResult found = solve(p, {5, 5}, options);
    EXPECT_EQ(found.status, Status::infeasible);
    if (method == Method::cobyla) continue;
    EXPECT_NEAR(found.violation, 3 - x, 1e-7);
    EXPECT_NEAR(found.x[0], x, 1e-6);
    EXPECT_LE(found.kkt_residual, 1e-6);
  }
}

TEST(Minimise, FeasiblePointsWithoutAnObjectiveAreNotInfeasible) {
  OptimisationProblem p = parabola(1, 0);  // values for x < 1 alone, rows for x ≥ 2 alone
  const auto f = p.objective;
  p.objective = [f](Point x, Values g) { return x[0] < 1 ? f(x, g) : nan; };
  p.inequality = {1,
                  [](Point x, Values c, Values j) {
                    c[0] = 2 - x[0];
                    fill(j, {-1});
                  },
                  {}};
  const Status status = solve(p, {0}).status;
  EXPECT_TRUE(status == Status::stalled || status == Status::evaluation_limit);
}

TEST(Minimise, ContradictoryEqualities) {
  OptimisationProblem p = parabola(2, 0);
  p.equality = {2,
                [](Point x, Values c, Values j) {
                  c[0] = x[0] + x[1] - 1;
                  c[1] = x[0] + x[1] - 2;
                  fill(j, {1, 1, 1, 1});
                },
                {}};
  const OptimisationResult found = solve(p, {0, 0});
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_NEAR(found.violation, 0.5, 1e-7);
}

TEST(Minimise, FindsAFeasiblePointFarFromTheStart) {
  KnownProblem k = hs43();
  expect_minimum(k, solve(k.problem, {100, -100, 100, -100}), 2e-7, 1e-4);
  k = hs71();
  expect_minimum(k, solve(k.problem, {5, 5, 5, 5}), 2e-7, 1e-4);
}

TEST(Minimise, KeepsToTheLargestNumberOfEvaluations) {
  for (const Method method : {Method::slsqp, Method::mma, Method::cobyla}) {
    OptimisationOptions options;
    options.method = method;
    options.max_evaluations = 10;
    const OptimisationResult found = solve(rosenbrock().problem, rosenbrock().start, options);
    EXPECT_EQ(found.status, Status::evaluation_limit);
    EXPECT_LE(found.evaluations, 13);
    EXPECT_LT(found.objective, 24.2);
  }
}

struct StopAt final : Progress {
  explicit StopAt(std::size_t last) : left(last) {}
  void report(std::string_view stage, double fraction, std::string_view) override {
    EXPECT_EQ(stage, "optimise");
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    if (left-- == 0) throw Stopped(StopReason::cancelled);
  }
  std::size_t left;
};

TEST(Minimise, ACancelEndsItBeforeTheNextEvaluation) {
  for (const Method method : {Method::slsqp, Method::mma, Method::cobyla, Method::isres, Method::direct_l})
    for (const std::size_t last : {0, 1, 2, 7, 40}) {
      KnownProblem k = rosenbrock();
      k.problem.lower = {-2, -2};
      k.problem.upper = {2, 2};
      std::size_t calls = 0;
      const auto f = k.problem.objective;
      k.problem.objective = [&](Point x, Values g) {
        ++calls;
        return f(x, g);
      };
      OptimisationOptions options;
      options.method = method;
      StopAt stop(last);
      EXPECT_THROW(minimise(k.problem, k.start, options, stop), Stopped);
      EXPECT_EQ(calls, last);
    }
}

TEST(Minimise, WhatACallbackThrowsComesOutUnchanged) {
  struct Own {
    int code;
  };
  for (const bool in_rows : {false, true})
    for (const Method method : {Method::slsqp, Method::mma, Method::cobyla}) {
      KnownProblem k = hs43();
      int calls = 0;
      const auto count = [&] {
        if (++calls == 5) throw Own{42};
      };
      const auto f = k.problem.objective;
      const auto c = k.problem.inequality.evaluate;
      if (in_rows) {
        k.problem.inequality.evaluate = [&](Point x, Values values, Values j) {
          count();
          c(x, values, j);
        };
      } else {
        k.problem.objective = [&](Point x, Values g) {
          count();
          return f(x, g);
        };
      }
      OptimisationOptions options;
      options.method = method;
      try {
        solve(k.problem, k.start, options);
        ADD_FAILURE();
      } catch (const Own& own) {
        EXPECT_EQ(own.code, 42);
      }
      EXPECT_EQ(calls, 5);
    }
}

TEST(Minimise, SameSeedSameBitsInSeveralThreadsAtOnce) {
  KnownProblem k = rosenbrock();
  k.problem.lower = {-2, -2};
  k.problem.upper = {2, 2};
  for (const Method method : {Method::slsqp, Method::mma, Method::cobyla, Method::isres, Method::direct_l}) {
    OptimisationOptions options;
    options.method = method;
    options.max_evaluations = 3000;
    const OptimisationResult alone = solve(k.problem, k.start, options);
    std::array<OptimisationResult, 8> found;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < found.size(); ++i)
      threads.emplace_back([&, i] {
        OptimisationOptions own = options;
        own.seed = 1 + i % 2;
        solve(k.problem, k.start, own);  // leaves NLopt's generator somewhere else
        found[i] = solve(k.problem, k.start, own);
      });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < found.size(); ++i) {
      const OptimisationResult& expected = i % 2 == 0 ? alone : found[1];
      EXPECT_EQ(found[i].x, expected.x);
      EXPECT_EQ(found[i].objective, expected.objective);
      EXPECT_EQ(found[i].evaluations, expected.evaluations);
    }
    if (method == Method::isres) {
      EXPECT_NE(found[1].x, alone.x);
    }
  }
}

TEST(Minimise, RefusesWhatAMethodCannotTake) {
  const auto refused = [](OptimisationProblem p, std::vector<double> start, Method method) {
    OptimisationOptions options;
    options.method = method;
    EXPECT_THROW(solve(p, start, options), std::invalid_argument);
  };
  OptimisationProblem p = parabola(2, 0);
  refused(p, {1}, Method::slsqp);
  refused(p, {1, nan}, Method::slsqp);
  refused(p, {1, 1}, Method::isres);
  refused(p, {1, 1}, Method::direct_l);
  refused(hs71().problem, hs71().start, Method::mma);
  refused(hs71().problem, hs71().start, Method::direct_l);
  p.scale = {1, 0};
  refused(p, {1, 1}, Method::slsqp);
  p = parabola(2, 0);
  p.lower = {nan, 0};
  refused(p, {1, 1}, Method::slsqp);
  p = parabola(2, 0);
  p.inequality.rows = 1;
  refused(p, {1, 1}, Method::slsqp);
}

}  // namespace
}  // namespace bahnwerk
