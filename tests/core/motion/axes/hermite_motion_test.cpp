#include "core/motion/axes/hermite_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace bahnwerk {
namespace {

/// One axis that swings, in two pieces, of which one lasts no time.
class Swing final : public Motion {
 public:
  explicit Swing(double first = 1) : first_(first) {}
  std::size_t axes() const override { return 1; }
  std::size_t pieces() const override { return 3; }
  double begin(std::size_t piece) const override { return piece == 0 ? 0 : 1; }
  double duration() const override { return 2; }
  MotionState in_piece(std::size_t piece, double t) const override {
    const double w = piece == 0 ? first_ : 3;
    MotionState x;
    x[0][0] = std::sin(w * (t - 1)), x[1][0] = w * std::cos(w * (t - 1));
    x[2][0] = -w * w * std::sin(w * (t - 1));
    return x;
  }

 private:
  double first_;  // what it swings at in the first piece: other than 3 its velocity jumps where the pieces meet
};

TEST(HermiteMotion, IsOfSixthOrder) {
  const Swing swing(3);
  for (const double longest : {0.5, 0.25, 0.1}) {
    const SplineMotion spline = hermite_motion(swing, 0, 1, longest);
    EXPECT_DOUBLE_EQ(spline.duration(), 2);
    double worst = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = 2 * i / 1000.0;
      worst = std::fmax(worst, std::abs(spline.evaluate(t)[0][0] - swing.evaluate(t)[0][0]));
    }
    const double allowed = std::pow(3, 6) * std::pow(longest, 6) / 46080;  // max|x⁽⁶⁾| = 3⁶
    EXPECT_LE(worst, allowed * 1.001 + 1e-15);
    EXPECT_GE(worst, allowed * 0.2);
  }
}

TEST(HermiteMotion, ReproducesQuintics) {
  const SplineMotion quintic({{1.5, {{1, -2, 3, 0.5, -0.25, 0.125}}}});
  const SplineMotion again = hermite_motion(quintic, 0, 1, 0.4);
  EXPECT_EQ(again.pieces(), 4u);
  for (const double t : {0.1, 0.7, 1.3}) {
    EXPECT_NEAR(again.evaluate(t)[0][0], quintic.evaluate(t)[0][0], 1e-13);
    EXPECT_NEAR(again.evaluate(t)[3][0], quintic.evaluate(t)[3][0], 1e-9);
  }
}

/// Differences of positions over 1e-8 s are nothing but rounding.
TEST(HermiteMotion, ShortPiecesKeepTheAcceleration) {
  const SplineMotion pieces({{0.5, {{100, 200, -3000}}}, {0.5 + 1e-8, {{100 + 100 - 750, 200 - 3000, 4000}}}});
  const SplineMotion again = hermite_motion(pieces, 0, 1, 1);
  ASSERT_EQ(again.pieces(), 2u);
  EXPECT_NEAR(again.in_piece(1, 0.5 + 5e-9)[2][0], 8000, 1e-9);
  EXPECT_NEAR(again.in_piece(0, 0.25)[2][0], -6000, 1e-8);
}

TEST(HermiteMotion, IsContinuousWhereTheMotionsVelocityJumps) {
  const SplineMotion spline = hermite_motion(Swing(), 0, 1, 0.5);
  ASSERT_EQ(spline.pieces(), 4u);
  for (std::size_t i = 1; i < 4; ++i) {
    const double t = spline.begin(i);
    EXPECT_NEAR(spline.in_piece(i - 1, t)[0][0], spline.in_piece(i, t)[0][0], 4e-15);
    EXPECT_NEAR(spline.in_piece(i - 1, t)[1][0], spline.in_piece(i, t)[1][0], 1e-14);
  }
  EXPECT_NEAR(spline.in_piece(3, 1.5)[1][0], 3 * std::cos(1.5), 1e-13);  // a piece later it is that of the motion
}

}  // namespace
}  // namespace bahnwerk
