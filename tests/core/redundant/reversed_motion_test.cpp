#include "core/redundant/reversed_motion.hpp"

#include <gtest/gtest.h>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

TEST(ReversedMotion, IsWhereTheOtherWasAsLongBeforeItsEnd) {
  std::vector<SplineMotion::Piece> pieces(3);
  pieces[0].end = 0.25, pieces[0].axes = {{0, 0, 8}, {1, 2, 3, 4, 5}};
  pieces[1].end = 0.5, pieces[1].axes = {{0.5, 4}, {2}};
  pieces[2].end = 1.5, pieces[2].axes = {{1.5, 4, -2}, {7, 0, 0, -1}};
  const auto motion = std::make_shared<const SplineMotion>(pieces);
  const ReversedMotion back(motion);
  ASSERT_EQ(back.pieces(), 3u);
  EXPECT_EQ(back.duration(), 1.5);
  EXPECT_EQ(back.begin(1), 1.0);
  EXPECT_EQ(back.begin(2), 1.25);
  for (std::size_t i = 0; i < 3; ++i)
    for (const double at : {0.0, 0.3, 1.0}) {
      const double t = back.begin(i) + at * (back.end(i) - back.begin(i));
      const MotionState x = back.in_piece(i, t), y = motion->in_piece(2 - i, 1.5 - t);
      for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(x[0][k], y[0][k], 1e-14);
        EXPECT_NEAR(x[1][k], -y[1][k], 1e-14);
        EXPECT_NEAR(x[2][k], y[2][k], 1e-13);
        EXPECT_NEAR(x[3][k], -y[3][k], 1e-12);
        Polynomial p;
        ASSERT_TRUE(back.polynomial(i, k, p));
        const double tau = t - back.begin(i);
        EXPECT_NEAR(evaluate(p, tau), y[0][k], 1e-13);
        EXPECT_NEAR(evaluate(derivative(p), tau), -y[1][k], 1e-12);
      }
    }
}

}  // namespace
}  // namespace bahnwerk
