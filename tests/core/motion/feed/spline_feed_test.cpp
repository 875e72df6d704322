// The feed as a B-spline, optimised: verified, no quicker than the optimum, and not far from it.
#include "core/motion/feed/spline_feed.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

TimeLaw planned(const test::FeedProblem& problem, const Limits& along = {}) {
  Progress progress;
  SplineFeedOptions options;
  options.path = along;
  return plan_spline_feed(*problem.task, options, progress).law;
}

double optimum(const test::FeedProblem& problem, const Limits& along = {}) {
  Progress progress;
  JerkLimitedOptions options;
  options.path = along;
  return plan_jerk_limited(*problem.task, options, progress).law.duration();
}

TEST(SplineFeed, IsNearTheShortestMoveOnALine) {
  const test::FeedProblem problem({200}, {}, 1);
  Limits along;
  along.velocity = 100, along.acceleration = 400, along.jerk = 3000;
  const TimeLaw law = planned(problem, along);
  EXPECT_EQ(test::faults(problem, law, along, 3, 1e-4), "");
  const double change = 100.0 / 400 + 400.0 / 3000, least = 2 * change + (200 - 100 * change) / 100;
  EXPECT_GE(law.duration(), least * (1 - 1e-9));
  EXPECT_LE(law.duration(), 1.15 * least);
}

TEST(SplineFeedProperty, IsVerifiedAndNoQuickerThanTheOptimum) {
  Random random(5);
  for (int n = 0; n < 2; ++n) {
    std::vector<double> legs, turns;
    for (int i = 0; i < 3; ++i) legs.push_back(random.uniform(20, 60)), turns.push_back(random.uniform(-1.5, 1.5));
    const test::FeedProblem problem(legs, turns, random.uniform(5, 15));
    const TimeLaw law = planned(problem);
    EXPECT_EQ(test::faults(problem, law, {}, 3, 1e-4), "") << n;
    const double least = optimum(problem);
    EXPECT_GE(law.duration(), least * (1 - 1e-6)) << n;
    EXPECT_LE(law.duration(), least * 1.35) << n;
  }
}

TEST(SplineFeed, RefusesRestsWithin) {
  const test::FeedProblem problem({30, 30}, {0.5}, 5);
  problem.task->rests[1] = true;
  EXPECT_THROW(planned(problem), InvalidInput);
}

TEST(SplineFeed, Stops) {
  struct Stopping final : ProgressSink {
    int left = 20;
    void report(std::string_view, double, std::string_view) override {
      if (--left == 0) throw Stopped(StopReason::cancelled);
    }
  } progress;
  const test::FeedProblem problem({30, 30}, {0.5}, 5);
  EXPECT_THROW(plan_spline_feed(*problem.task, {}, progress), Stopped);
}

}  // namespace
}  // namespace bahnwerk
