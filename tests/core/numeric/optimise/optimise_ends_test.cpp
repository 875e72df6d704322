// How minimising ends where there is no minimum to be found: contradictions, budgets, cancels, exceptions, refusals.
#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/optimise/optimise.hpp"
#include "tests/core/numeric/optimise/problems.hpp"
#include "tests/core/numeric/optimise/solving.hpp"

namespace bahnwerk {
namespace {

using test::expect_minimum;
using test::Method;
using test::nan;
using test::parabola;
using test::solve;
using test::Status;

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

TEST(Minimise, ExceptionsOfCallbacksArePassedOnUnchanged) {
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
