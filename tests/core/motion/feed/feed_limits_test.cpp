// What the limits leave to the feed: closed forms on lines and arcs, and dense samples on free curves.
#include "core/motion/feed/feed_limits.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/geometry/curve/arc.hpp"
#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

FeedGrid grid_of(const PathTask& task, FeedGridOptions options = {}) {
  static Progress progress;
  ProgressScope stage_progress(progress, "test");
  return {task, options, stage_progress};
}

/// On a quarter circle of radius r each axis has q′ up to 1, q″ up to 1/r, q‴ up to 1/r².
TEST(FeedLimits, ValuesOnACircleAreKnown) {
  const double r = 20;
  Path tool;
  tool.append(std::make_shared<Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, r, 2, 0), 0);
  const CartesianAxisPath axes(tool, 2);
  const Machine machine{{{"x", 500, 4000, 80000}, {"y", 500, 4000, 80000}}, 0.001};
  PathTask task{axes, machine, {unlimited}, {true, true}};
  const FeedGrid grid = grid_of(task);
  EXPECT_NEAR(grid.hold(0).speed, std::min({500.0, std::sqrt(4000 * r), std::cbrt(80000 * r * r)}), 1e-6);
  EXPECT_EQ(grid.hold(0).kind, FeedLimit::Kind::acceleration);
  EXPECT_NE(in_words(grid.hold(0), machine).find("acceleration limit of "), std::string::npos);

  // Without the places where x or y is slowest: only the jerk at the middle of this part is left of x.
  FeedGridOptions no_jerk;
  no_jerk.order = 2;
  EXPECT_GE(grid_of(task, no_jerk).hold(0).speed, grid.hold(0).speed);

  task.feeds[0] = 3;
  EXPECT_EQ(grid_of(task).hold(0).speed, 3);
  EXPECT_EQ(grid_of(task).hold(0).kind, FeedLimit::Kind::segment_feed);
  FeedGridOptions slow;
  slow.along.velocity = 2;
  EXPECT_EQ(grid_of(task, slow).hold(0).speed, 2);
  EXPECT_EQ(grid_of(task, slow).hold(0).kind, FeedLimit::Kind::path_velocity);
}

TEST(FeedLimits, TheSlowestPlaceIsFoundBetweenTheNodes) {
  Random random(3);
  for (int n = 0; n < 30; ++n) {
    const test::FeedProblem problem(random);
    const FeedGrid grid = grid_of(*problem.task);
    for (std::size_t i = 0; i < problem.tool.size(); ++i) {
      double least = problem.task->feeds[i];
      for (int k = 0; k <= 4000; ++k) {
        const Curve& curve = problem.tool[i].curve();
        const AxisJet q = problem.axes->at_parameter(i, curve.begin() + (curve.end() - curve.begin()) * k / 4000.0);
        for (std::size_t a = 0; a < 2; ++a) {
          const AxisLimits& axis = problem.machine.axes[a];
          least = std::min({least, axis.velocity / std::abs(q.d1[a]), std::sqrt(axis.acceleration / std::abs(q.d2[a])),
                            std::cbrt(axis.jerk / std::abs(q.d3[a]))});
        }
      }
      EXPECT_LE(grid.hold(i).speed, least * (1 + 1e-9));
      const bool joint = grid.hold(i).kind == FeedLimit::Kind::velocity_step ||
                         grid.hold(i).kind == FeedLimit::Kind::acceleration_step;
      EXPECT_TRUE(joint || grid.hold(i).speed >= least * (1 - 1e-5));
      // Parts allow as much or more; the slowest one as much, but for its joints.
      double parts = unlimited;
      const double s0 = problem.tool[i].s0(), l = problem.tool[i].length();
      for (int p = 0; p < 4; ++p) {
        const double part = grid.hold_between(i, s0 + p * l / 4, p == 3 ? problem.tool[i].s1() : s0 + (p + 1) * l / 4);
        EXPECT_GE(part, grid.hold(i).speed * (1 - 1e-9));
        parts = std::min(parts, part);
      }
      EXPECT_NEAR(parts, grid.hold(i).speed, 1e-6 * parts);
    }
  }
}

/// share() solves what it says: with its factor a limit is reached, with none exceeded.
TEST(FeedLimits, ShareEndsWhereALimitIsReached) {
  Random random(4);
  const test::FeedProblem problem({10, 10}, {1}, 10);
  const FeedGrid grid = grid_of(*problem.task);
  int partial = 0;
  for (int n = 0; n < 20000; ++n) {
    const FeedNode node = grid.node(random.below(grid.size()));
    const FeedState x{std::pow(10, random.uniform(0, 2.5)), random.uniform(-1, 1) * 5000, random.uniform(-1, 1) * 1e5};
    const auto strain = [&](double f) {
      double most = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        const AxisLimits& axis = problem.machine.axes[k];
        most = std::max(
            {most, std::abs(node.d1[k]) * x.v / axis.velocity,
             std::abs(node.d2[k] * x.v * x.v + node.d1[k] * f * x.a) / axis.acceleration,
             std::abs(node.d3[k] * x.v * x.v * x.v + 3 * node.d2[k] * x.v * f * x.a + node.d1[k] * f * f * x.j) /
                 axis.jerk});
      }
      return most;
    };
    const double f = grid.share(node, x, 1);
    if (f == 0) {
      EXPECT_GE(strain(0), 1 - 1e-9);
      continue;
    }
    EXPECT_LE(strain(f), 1 + 1e-9);
    if (f == 1) continue;
    EXPECT_GE(strain(f * (1 + 1e-6)), 1) << f;
    ++partial;
  }
  EXPECT_GT(partial, 1000);
}

}  // namespace
}  // namespace bahnwerk
