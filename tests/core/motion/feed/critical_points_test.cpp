// A feed per piece of the path: verified, never slower than one feed for all, never faster than the optimised one.
#include "core/motion/feed/critical_points.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/motion/profile/profile.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

TimeLaw planned(const test::FeedProblem& problem, const FeedOptions& options) {
  Progress progress;
  return plan_critical_points(*problem.task, options, progress);
}

/// A slow segment between two fast ones, all on a line: one straight move after the other, in closed form.
TEST(CriticalPoints, ASlowPieceOfALine) {
  test::FeedProblem problem({100, 100, 100}, {0, 0}, 10);
  ASSERT_EQ(problem.tool.size(), 5u);
  problem.task->feeds = {100, 20, 20, 20, 100};
  FeedOptions options;
  options.path.acceleration = 400, options.path.jerk = 3000;
  for (const auto& [profile, name] : speed_profiles) {
    options.profile = profile;
    const auto change = [&row = speed_profile_row(profile)](double height) {
      return row.rise(height, 400, 3000).duration;
    };
    const double side = change(100) + change(80) + (100 - 50 * change(100) - 60 * change(80)) / 100;
    EXPECT_NEAR(planned(problem, options).duration(), 2 * side + 140 / 20.0, 1e-9) << name;
  }
}

/// Between two slow segments lies one that is too short for its feed: as much of it is reached as there is room for.
TEST(CriticalPoints, AShortPieceIsPassedAtAsMuchAsItIsLongEnoughFor) {
  test::FeedProblem problem({100, 3, 100}, {0, 0}, 10);
  problem.task->feeds = {20, 20, 200, 20, 20};
  FeedOptions options;
  options.path.acceleration = 400, options.path.jerk = 3000;
  const TimeLaw law = planned(problem, options);
  EXPECT_EQ(test::faults(problem, law, options.path, 3), "");
  const double top = straight_profile(3, 20, 20, {200, 400, 3000, unlimited}).turning_speed;
  EXPECT_LE(test::fastest(law), top * (1 + 1e-9));
  EXPECT_GE(test::fastest(law), top * (1 - 1e-3));
}

/// Where segments are shorter than a change needs, a change goes on over all of them.
TEST(CriticalPoints, ChangesGoOnOverManyShortPieces) {
  std::vector<double> legs(40, 0.5), turns(40, 1e-9);
  test::FeedProblem problem(legs, turns, 0.1);
  FeedOptions options;
  options.path.velocity = 50, options.path.acceleration = 400, options.path.jerk = 3000;
  const double change = speed_profile_row(SpeedProfile::double_s).rise(50, 400, 3000).duration,
               length = problem.tool.length();
  EXPECT_NEAR(planned(problem, options).duration(), 2 * change + (length - 50 * change) / 50, 1e-6);
}

/// On random paths: verified, and between the constant and the optimised feed.
TEST(CriticalPointsProperty, IsVerifiedAndBetweenTheOthers) {
  Random random(7);
  double gained = 0;
  for (int n = 0; n < testing::cases(40); ++n) {
    test::FeedProblem problem(random);
    for (const auto& [profile, name] : speed_profiles) {
      FeedOptions options;
      options.profile = profile;
      if (n % 2) {
        options.path.acceleration = std::pow(10, random.uniform(1, 4));
        options.path.jerk = std::pow(10, random.uniform(2, 6));
      }
      const TimeLaw law =
          test::verified(problem, options, plan_critical_points, std::string(name) + " " + std::to_string(n));
      Progress progress;
      const TimeLaw constant = plan_constant_feed(*problem.task, options, progress);
      EXPECT_LE(law.duration(), constant.duration()) << name << ' ' << n;
      gained += constant.duration() / law.duration() - 1;
      if (speed_profile_row(profile).order == 2) continue;
      JerkLimitedOptions optimised;
      optimised.path = options.path;
      EXPECT_GE(law.duration(), plan_jerk_limited(*problem.task, optimised, progress).law.duration() * (1 - 1e-3))
          << name << ' ' << n;
    }
  }
  EXPECT_GT(4 * gained, testing::cases(40));
}

}  // namespace
}  // namespace bahnwerk
