// A change of speed on a path: as quick as the limits along the path on a line, slower where axes need it.
#include "core/motion/feed/feed_change.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

FeedGrid grid_of(const PathTask& task, const FeedGridOptions& options) {
  static Progress progress;
  ProgressScope stage_progress(progress, "test");
  return {task, options, stage_progress};
}

TEST(FeedChange, IsTheProfileUnderTheLimitsAlongThePathOnALine) {
  const test::FeedProblem problem({100}, {}, 1);
  FeedGridOptions options;
  options.along.acceleration = 400, options.along.jerk = 3000;
  const FeedGrid grid = grid_of(*problem.task, options);
  for (const auto& [profile, name] : speed_profiles) {
    const FeedChanges changes(grid, profile);
    for (const bool forwards : {true, false}) {
      const auto change = changes.find(forwards ? 10 : 90, 20, 80, forwards, 60);
      ASSERT_TRUE(change) << name;
      EXPECT_NEAR(change->rise.duration, speed_profile_row(profile).rise(60, 400, 3000).duration, 1e-12) << name;
      EXPECT_NEAR(std::abs(change->far_end() - change->s), change->rise.duration * 50, 1e-12) << name;
      EXPECT_FALSE(changes.find(forwards ? 10 : 90, 20, 80, forwards, 0.99 * change->distance())) << name;
    }
  }
}

TEST(FeedChange, AxesOfALineLimitIt) {
  const test::FeedProblem problem({100}, {}, 1);
  const FeedGrid grid = grid_of(*problem.task, {});
  const auto change = FeedChanges(grid, SpeedProfile::double_s).find(0, 0, 80, true, 100);
  ASSERT_TRUE(change);
  const double share = std::cos(0.3);  // of x in the path's direction; y has 3000 and 60 000 in sin 0.3
  EXPECT_NEAR(change->rise.duration,
              speed_profile_row(SpeedProfile::double_s).rise(80, 4000 / share, 80000 / share).duration,
              5e-3 * change->rise.duration);  // with 0.1 to 0.3 % to spare
}

TEST(FeedChange, NoneAboveTheFeedOfASegment) {
  test::FeedProblem problem({10, 10}, {0.5}, 5);
  problem.task->feeds[1] = 30;
  const FeedGrid grid = grid_of(*problem.task, {});
  const FeedChanges changes(grid, SpeedProfile::double_s);
  EXPECT_TRUE(changes.find(9.9, 10, 29, true, 20));
  EXPECT_FALSE(changes.find(9.9, 10, 40, true, 20)) << "would be over 30 within the link";
}

/// Everywhere on what is found, between the nodes too, the axes keep their limits.
TEST(FeedChangeProperty, KeepsAllLimitsBetweenTheNodes) {
  Random random(5);
  int found = 0;
  for (int n = 0; n < testing::cases(200); ++n) {
    const test::FeedProblem problem(random);
    const FeedGrid grid = grid_of(*problem.task, {});
    const FeedChanges changes(grid, n % 2 ? SpeedProfile::double_s : SpeedProfile::trigonometric);
    const double length = problem.tool.length(), s = random.uniform(0, length);
    double slowest = unlimited;
    for (std::size_t i = 0; i < problem.tool.size(); ++i) slowest = std::min(slowest, grid.hold(i).speed);
    const double low = slowest * random.uniform(0, 0.9), high = low + slowest * random.uniform(0, 1);
    const bool forwards = random.chance(0.5);
    const auto change = changes.find(s, low, high, forwards, forwards ? length - s : s);
    if (!change) continue;
    ++found;
    double x = 0;
    for (const RisePiece& p : change->rise.pieces())
      for (int k = 0; k <= 20; ++k) {
        const double t = p.duration * k / 20;
        const double v = low + p.v + t * (p.a + t * (p.j / 2 + t * p.snap / 6)),
                     a = (forwards ? 1 : -1) * (p.a + t * (p.j + t * p.snap / 2)), j = p.j + t * p.snap;
        const double way = t * (low + p.v + t * (p.a / 2 + t * (p.j / 6 + t * p.snap / 24)));
        const double at = std::clamp(forwards ? s + x + way : s - x - way, 0.0, length);
        if (k == 20) x += way;
        const std::size_t segment = problem.tool.find(at);
        const AxisJet q = problem.axes->at(segment, at);
        for (std::size_t i = 0; i < 2; ++i) {
          const AxisLimits& axis = problem.machine.axes[i];
          ASSERT_LE(std::abs(q.d1[i] * v), axis.velocity * (1 + 2e-4));
          ASSERT_LE(std::abs(q.d2[i] * v * v + q.d1[i] * a), axis.acceleration * (1 + 1e-3));
          ASSERT_LE(std::abs(q.d3[i] * v * v * v + 3 * q.d2[i] * v * a + q.d1[i] * j), axis.jerk * (1 + 1e-2));
        }
        if (at > problem.tool[segment].s0() + 1e-9) {
          ASSERT_LE(v, problem.task->feeds[segment] * (1 + 1e-9));
        }
      }
  }
  EXPECT_GT(5 * found, 2 * testing::cases(200));
}

}  // namespace
}  // namespace bahnwerk
