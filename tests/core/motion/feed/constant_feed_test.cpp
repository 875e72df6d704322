// The constant feed: closed forms, verified, the largest one, and what breaks a limit is named.
#include "core/motion/feed/constant_feed.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

TimeLaw planned(const test::FeedProblem& problem, const FeedOptions& options) {
  Progress progress;
  return plan_constant_feed(*problem.task, options, progress);
}

TEST(ConstantFeed, IsAStraightMoveOnALine) {
  const test::FeedProblem problem({200}, {}, 1);
  FeedOptions options;
  options.path.velocity = 100, options.path.acceleration = 400, options.path.jerk = 3000;
  for (const auto& [profile, name] : speed_profiles) {
    options.profile = profile;
    const double change = speed_profile_row(profile).rise(100, 400, 3000).duration;
    // Both changes take a way of change · 50 each.
    EXPECT_NEAR(planned(problem, options).duration(), 2 * change + (200 - 100 * change) / 100, 1e-9) << name;
  }
}

TEST(ConstantFeed, AShortPathIsPassedAtAsMuchAsItIsLongEnoughFor) {
  const test::FeedProblem problem({0.5}, {}, 1);
  FeedOptions options;
  options.path.velocity = 100, options.path.acceleration = 400, options.path.jerk = 3000;
  const TimeLaw law = planned(problem, options);
  // Two changes of height v with T = 2 √(v/J) each: v T = 0.5.
  const double v = std::pow(0.25 * std::sqrt(3000.0), 2.0 / 3);
  EXPECT_NEAR(test::fastest(law), v, 1e-6 * v);
  options.feed = 100;
  options.path.velocity = unlimited;
  EXPECT_THROW(planned(problem, options), FeedTooFast);
}

TEST(ConstantFeed, AFeedThatWasAskedForIsHeldOrRefused) {
  const test::FeedProblem problem({30, 40, 20}, {0.8, -1.2}, 8);
  FeedOptions options;
  const double largest = test::fastest(planned(problem, options));
  options.feed = 0.9 * largest;
  EXPECT_NEAR(test::fastest(planned(problem, options)), 0.9 * largest, 1e-9 * largest);
  options.feed = 1.01 * largest;
  try {
    planned(problem, options);
    ADD_FAILURE() << "planned";
  } catch (const FeedTooFast& error) {
    EXPECT_NEAR(error.limit.speed, largest, 1e-8 * largest);
    EXPECT_EQ(error.asked, options.feed);
    const std::string text = error.what();
    EXPECT_NE(text.find("limit of "), std::string::npos) << text;
    // The place it names is one that allows no more.
    EXPECT_TRUE(error.limit.segment == 1 || error.limit.segment == 3) << error.limit.segment;
  }
  options.feed = largest;
  EXPECT_NEAR(test::fastest(planned(problem, options)), largest, 1e-8 * largest);
}

/// Rests within the path are kept; every section has the same feed.
TEST(ConstantFeed, RestsWhereTheTaskDoes) {
  test::FeedProblem problem({30, 40, 50}, {0.8, -1.2}, 8);
  problem.task->rests[2] = true;
  const TimeLaw law = planned(problem, {});
  EXPECT_EQ(test::faults(problem, law, {}, 3, 1e-4), "");
  bool rested = false;
  for (const LawPiece& piece : law.pieces()) rested = rested || (piece.segment == 2 && piece.v == 0);
  EXPECT_TRUE(rested);
}

TEST(ConstantFeed, IsRefusedWithoutAnyLimitOfAcceleration) {
  test::FeedProblem problem({30}, {}, 8);
  for (AxisLimits& axis : problem.machine.axes) axis = {axis.name, 100};
  EXPECT_THROW(planned(problem, {}), InvalidInput);
}

/// Verified on random paths, with every profile; looser limits are never slower; a feed 1 % above the largest one
/// breaks a limit, or leaves no room for its changes.
TEST(ConstantFeedProperty, IsVerifiedAndTheLargestOne) {
  Random random(6);
  for (int n = 0; n < testing::cases(60); ++n) {
    test::FeedProblem problem(random);
    for (const auto& [profile, name] : speed_profiles) {
      FeedOptions options;
      options.profile = profile;
      if (n % 2) {
        options.path.velocity = std::pow(10, random.uniform(0, 3));
        options.path.acceleration = std::pow(10, random.uniform(1, 4));
        options.path.jerk = std::pow(10, random.uniform(2, 6));
      }
      const TimeLaw law =
          test::verified(problem, options, plan_constant_feed, std::string(name) + " " + std::to_string(n));
      FeedOptions faster = options;
      faster.feed = 1.01 * test::fastest(law);
      EXPECT_THROW(planned(problem, faster), FeedTooFast) << name << ' ' << n;
      for (AxisLimits& axis : problem.machine.axes) axis.velocity *= 2, axis.acceleration *= 4, axis.jerk *= 8;
      EXPECT_LE(planned(problem, options).duration(), law.duration() * (1 + 1e-3)) << name << ' ' << n;
      for (AxisLimits& axis : problem.machine.axes) axis.velocity /= 2, axis.acceleration /= 4, axis.jerk /= 8;
    }
  }
}

}  // namespace
}  // namespace bahnwerk
