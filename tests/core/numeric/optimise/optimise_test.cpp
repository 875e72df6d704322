#include "core/numeric/optimise/optimise.hpp"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <thread>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
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

constexpr std::array methods{Method::slsqp, Method::cobyla};

// The gradients of the test problems themselves.
TEST(GradientCheck, HoldsForTheTestProblems) {
  for (const KnownProblem& k : {tutorial(), rosenbrock(), hs35(), hs43(), hs100(), banded_quadratic(10)})
    EXPECT_LT(gradient_error(k.problem, k.start), 1e-7);
}

TEST(GradientCheck, FindsAWrongOne) {
  KnownProblem k = hs35();
  k.problem.inequality.evaluate = [](Point x, Values c, Values j) {
    c[0] = x[0] + x[1] + 2 * x[2] - 3;
    fill(j, {1, 1, 1});
  };
  EXPECT_GT(gradient_error(k.problem, k.start), 0.1);
}

TEST(Minimise, KnownMinimaBySlsqp) {
  for (const double step : {1e-9, 1e-12}) {
    OptimisationOptions options;
    options.step_tolerance = step;
    for (const KnownProblem& k : {tutorial(), rosenbrock(), hs35(), hs43(), banded_quadratic(40)})
      expect_minimum(k, solve(k.problem, k.start, options), 2e-7, 1e-4);
  }
}

TEST(Minimise, KnownMinimaByCobyla) {
  OptimisationOptions options;
  options.method = Method::cobyla;
  options.step_tolerance = 1e-5;
  for (const KnownProblem& k : {tutorial(), hs35(), hs43(), hs100()}) {
    const OptimisationResult found = solve(k.problem, k.start, options);
    EXPECT_NEAR(found.objective, k.minimum, 1e-5);
    EXPECT_LE(found.violation, 1e-8);
  }
}

TEST(Minimise, ScalesOfVariablesAndObjective) {
  KnownProblem k = hs43();
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
  p.inequality.evaluate = [=](Point x, Values c, Values j) {
    inner.inequality.evaluate(point(x), c, j);
    for (std::size_t i = 0; i < j.size(); ++i) j[i] /= unit[i % 4];
  };
  p.scale.assign(unit.begin(), unit.end());
  p.objective_scale = 1e-4;
  OptimisationResult found = solve(p, k.start);
  EXPECT_NEAR(found.objective, 1e-4 * k.minimum, 1e-10);
  found.objective *= 1e4;
  for (std::size_t j = 0; j < 4; ++j) found.x[j] /= unit[j];
  expect_minimum(k, found, 1e-6, 1e-4);
}

TEST(Minimise, VariablesThatAreFixedAndBoundsThatAreActive) {
  OptimisationProblem p = parabola(3, 2);
  p.lower = {0, -infinity, 0.5};
  p.upper = {1, infinity, 0.5};
  expect_minimum({p, {}, 3.25, {1, 2, 0.5}}, solve(p, {0.5, 0, 0.5}), 1e-9, 1e-6);
}

TEST(Minimise, StartsOutsideTheBoundsAndNeverLeavesThem) {
  for (const Method method : methods) {
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
    for (const Method method : methods) {
      OptimisationOptions options;
      options.method = method;
      EXPECT_NEAR(solve(p, {50}, options).x.at(0), 1, 1e-3);
    }
  }
}

TEST(Minimise, UndefinedEverywhereHasNoPoint) {
  OptimisationProblem p = parabola(2, 0);
  p.objective = [](Point, Values) { return nan; };
  for (const Method method : methods) {
    OptimisationOptions options;
    options.method = method;
    options.max_evaluations = 100;
    const OptimisationResult found = solve(p, {1, 1}, options);
    EXPECT_TRUE(found.x.empty());
    EXPECT_TRUE(std::isnan(found.objective));
  }
}

TEST(Minimise, GradientsThatAreNotSetEndTheSearch) {
  OptimisationProblem p = parabola(2, 0);
  p.objective = [](Point x, Values) { return x[0] * x[0] + x[1] * x[1]; };
  const OptimisationResult found = solve(p, {1, 1});
  EXPECT_EQ(found.evaluations, 1);
  EXPECT_THAT(found.x, testing::ElementsAre(1, 1));
}

TEST(Minimise, KeepsTheBestFeasiblePointWhateverTheEnd) {
  for (const Method method : methods)
    for (const std::size_t most : {1, 2, 5, 10, 20}) {
      KnownProblem k = hs35();
      double best = infinity;
      const OptimisationProblem inner = k.problem;
      k.problem.objective = [&](Point x, Values g) {
        double c = 0;
        inner.inequality.evaluate(x, {&c, 1}, {});
        const double f = inner.objective(x, g);
        if (c <= 1e-8) best = std::min(best, f);
        return f;
      };
      OptimisationOptions options;
      options.method = method;
      options.max_evaluations = most;
      EXPECT_EQ(solve(k.problem, k.start, options).objective, best);
    }
}

TEST(Minimise, KeepsToTheLargestNumberOfEvaluations) {
  for (const Method method : methods) {
    OptimisationOptions options;
    options.method = method;
    options.max_evaluations = 10;
    const OptimisationResult found = solve(rosenbrock().problem, rosenbrock().start, options);
    EXPECT_LE(found.evaluations, 11);
    EXPECT_LE(found.objective, 24.2);
  }
}

struct StopAt final : ProgressSink {
  explicit StopAt(std::size_t last) : left(last) {}
  void report(std::string_view stage, double fraction, std::string_view) override {
    EXPECT_EQ(stage, "optimise");
    EXPECT_TRUE(fraction >= 0 && fraction <= 1);
    if (left-- == 0) throw Stopped(StopReason::cancelled);
  }
  std::size_t left;
};

TEST(Minimise, ACancelEndsItBeforeTheNextEvaluation) {
  for (const Method method : methods)
    for (const std::size_t last : {0, 1, 2, 7, 20}) {
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

TEST(Minimise, ExceptionsOfCallbacksArePassedOnUnchanged) {
  struct Own {
    int code;
  };
  for (const bool in_rows : {false, true})
    for (const Method method : methods) {
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

TEST(Minimise, SameBitsInSeveralThreadsAtOnce) {
  const KnownProblem k = rosenbrock();
  for (const Method method : methods) {
    OptimisationOptions options;
    options.method = method;
    options.max_evaluations = 3000;
    const OptimisationResult alone = solve(k.problem, k.start, options);
    std::array<OptimisationResult, 8> found;
    std::vector<std::thread> threads;
    for (OptimisationResult& each : found)
      threads.emplace_back([&each, &k, options] { each = solve(k.problem, k.start, options); });
    for (std::thread& thread : threads) thread.join();
    for (const OptimisationResult& each : found) {
      EXPECT_EQ(each.x, alone.x);
      EXPECT_EQ(each.objective, alone.objective);
      EXPECT_EQ(each.evaluations, alone.evaluations);
    }
  }
}

TEST(Minimise, RefusesSizesThatDoNotMatch) {
  OptimisationProblem p = parabola(2, 0);
  EXPECT_THROW(solve(p, {1}), std::invalid_argument);
  p.scale = {1};
  EXPECT_THROW(solve(p, {1, 1}), std::invalid_argument);
  p = parabola(2, 0);
  p.lower = {0, 0, 0};
  EXPECT_THROW(solve(p, {1, 1}), std::invalid_argument);
  EXPECT_THROW(solve(parabola(0, 0), {}), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
