// Feeds by curvature: the sagitta of arcs, the printed examples of the source, and the largest curvature of curves.
#include "core/motion/feed/curvature_feed.hpp"

#include <gtest/gtest.h>

#include "core/geometry/curve/arc.hpp"
#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

TEST(CurvatureFeed, TheChordOfACycleHasTheSagittaOfTheTolerance) {
  for (const double r : {0.5, 5.0, 500.0})
    for (const double e : {1e-6, 1e-3, 0.1}) {
      CurvatureFeedLimits limits;
      limits.chord_tolerance = e, limits.cycle_time = 0.002;
      const double half = chord_feed(1 / r, limits) * limits.cycle_time / 2;
      EXPECT_NEAR(r - std::sqrt(r * r - half * half), e, 1e-9 * r);
    }
  CurvatureFeedLimits source;
  source.chord_tolerance = 0.005, source.cycle_time = 0.002;
  EXPECT_NEAR(chord_feed(0.2, source), 223.55, 0.005);
  EXPECT_EQ(chord_feed(0, source), unlimited);
  EXPECT_EQ(chord_feed(0.2, {}), unlimited);
  source.chord_tolerance = 100;  // more than the circle is wide
  EXPECT_NEAR(chord_feed(0.2, source), 2 / 0.002 * 5, 1e-9);
}

TEST(CurvatureFeed, HalfTheSpeedIsAllowedAtItsCurvature) {
  CurvatureFeedLimits limits;
  limits.half_speed_curvature = 0.2, limits.velocity = 150;
  EXPECT_EQ(half_speed_feed(0, limits), 150);
  EXPECT_NEAR(half_speed_feed(0.2, limits), 75, 1e-12);
  EXPECT_NEAR(half_speed_feed(0.6, limits), 37.5, 1e-12);
  EXPECT_EQ(half_speed_feed(1, {}), unlimited);
}

TEST(CurvatureFeed, LargestCurvatureOfEverySegmentCounts) {
  const test::FeedProblem problem({10, 10}, {1.3}, 6);
  double most = 0;
  for (int k = 0; k <= 100000; ++k) {
    const Curve& curve = problem.tool[1].curve();
    most =
        std::max(most, norm(problem.tool[1].at_parameter(curve.begin() + k * 1e-5 * (curve.end() - curve.begin())).d2));
  }
  EXPECT_NEAR(largest_curvature(problem.tool[1]), most, 1e-8 * most);
  EXPECT_GE(largest_curvature(problem.tool[1]), most * (1 - 1e-12));
  CurvatureFeedLimits limits;
  limits.half_speed_curvature = most, limits.velocity = 100;
  const std::vector<double> feeds = curvature_feeds(problem.tool, limits);
  EXPECT_EQ(feeds[0], 100);
  EXPECT_NEAR(feeds[1], 50, 1e-6);
  Path circle;
  circle.append(std::make_shared<Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, 8, 2, 0), 0);
  EXPECT_NEAR(largest_curvature(circle[0]), 1.0 / 8, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
