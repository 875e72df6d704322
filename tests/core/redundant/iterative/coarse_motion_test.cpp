#include "core/redundant/iterative/coarse_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

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
    EXPECT_NEAR(s[0][0], x.in_piece(x.find(t, 0), t).x, 1e-13);
    EXPECT_NEAR(s[0][1], y.in_piece(y.find(t, 0), t).x, 1e-13);
    EXPECT_NEAR(s[1][1], y.in_piece(y.find(t, 0), t).v, 1e-13);
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
  EXPECT_EQ(motion->in_piece(1, 1.5)[2][0], 8);
  EXPECT_EQ(motion->in_piece(1, 1.5)[2][1], -8);
}

/// Next to rests numbers are small: what rounding leaves at knots is large beside them.
TEST(CoarseMotion, WithLimitsPiecesGoOnWhereTheOneBeforeEnded) {
  const Limits quick{1800, 16000}, smooth{1800, 16000, 1.6e6};
  for (const Limits& limits : {quick, smooth}) {
    Random random(3);
    const bool jerk = limits.jerk < unlimited;
    TimeSpline x;
    TimeSpline::Coefficients c{100, 0, 0, 2e5, 0, 0};
    for (int i = 0; i < 400; ++i) {
      const double h = random.chance(0.2) ? 1e-8 : random.uniform(1e-4, 2e-3);
      x.append(x.duration() + h, c);
      const AxisState end = x.in_piece(x.pieces() - 1, x.duration());
      const auto off = [&](double value) { return value + random.uniform(-1, 1) * 1e-13 * (1 + std::abs(value)); };
      c = {off(end.x), off(end.v), jerk ? off(end.a / 2) : random.uniform(-1, 1) * 4000, random.uniform(-1, 1) * 2e5,
           0,          0};
    }
    const auto motion = coarse_motion({x}, x.duration(), {limits});
    for (std::size_t i = 1; i < motion->pieces(); ++i) {
      const double t = motion->begin(i);
      const MotionState a = motion->in_piece(i - 1, t), b = motion->in_piece(i, t);
      ASSERT_EQ(a[0][0], b[0][0]);
      ASSERT_EQ(a[1][0], b[1][0]);
      if (jerk) {
        ASSERT_EQ(a[2][0], b[2][0]);
      }
      ASSERT_NEAR(b[0][0], x.in_piece(x.find(t, 0), t).x, 1e-9);
    }
  }
}

}  // namespace
}  // namespace bahnwerk
