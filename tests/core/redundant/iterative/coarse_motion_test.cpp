#include "core/redundant/iterative/coarse_motion.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(CoarseMotion, EveryAxisKeepsItsOwnPieces) {
  TimeSpline x, y;
  x.append(1, {0, 0, 1, 0, 0, 0});
  x.append(3, {1, 2, -0.5, 0, 0, 0});
  y.append(2, {5, -1, 0, 0.25, 0, 0});
  y.append(3 + 1e-15, y.from(0, 2));
  const auto motion = coarse_motion({x, y}, 3);
  EXPECT_EQ(motion->axes(), 2u);
  EXPECT_EQ(motion->pieces(), 3u);
  EXPECT_EQ(motion->duration(), 3);
  for (int i = 0; i <= 30; ++i) {
    const double t = 0.1 * i;
    const MotionState s = motion->evaluate(t);
    EXPECT_NEAR(s.position[0], x.in_piece(x.find(t, 0), t).x, 1e-13);
    EXPECT_NEAR(s.position[1], y.in_piece(y.find(t, 0), t).x, 1e-13);
    EXPECT_NEAR(s.velocity[1], y.in_piece(y.find(t, 0), t).v, 1e-13);
  }
}

TEST(CoarseMotion, KnotsThatDifferByRoundingAreOne) {
  TimeSpline x, y;
  x.append(1, {0, 1, 0, 0, 0, 0});
  x.append(2, {1, 1, 4, 0, 0, 0});
  y.append(1 + 4e-16, {0, 1, 0, 0, 0, 0});
  y.append(2, {1, 1, -4, 0, 0, 0});
  const auto motion = coarse_motion({x, y}, 2);
  EXPECT_EQ(motion->pieces(), 2u);
  EXPECT_EQ(motion->in_piece(1, 1.5).acceleration[0], 8);
  EXPECT_EQ(motion->in_piece(1, 1.5).acceleration[1], -8);
}

}  // namespace
}  // namespace bahnwerk
