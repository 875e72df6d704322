// Splines up to degree 21, whose peaks the verifier encloses as those of low degrees.
#include "core/motion/axes/spline_motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace bahnwerk {
namespace {

TEST(SplineMotion, DerivativesOfAMonomialOfDegree21) {
  Polynomial p(22);
  p[21] = 1;
  const SplineMotion motion({{1, {p}}});
  const MotionState end = motion.final_state();
  EXPECT_DOUBLE_EQ(end[0][0], 1);
  EXPECT_DOUBLE_EQ(end[1][0], 21);
  EXPECT_DOUBLE_EQ(end[2][0], 21 * 20);
  EXPECT_DOUBLE_EQ(end[3][0], 21 * 20 * 19);
  EXPECT_DOUBLE_EQ(end[4][0], 21 * 20 * 19 * 18);
}

TEST(SplineMotion, SlowedItIsAtTheSamePlacesLater) {
  const std::vector<SplineMotion::Piece> pieces{{1, {{1, 2, 3, 4, 5}}}, {3, {{15, -1, 0.5}}}};
  const SplineMotion given(pieces), slow(slowed(pieces, 2));
  EXPECT_EQ(slow.duration(), 6);
  for (const double t : {0.25, 0.5, 1.5, 2.75}) {
    const MotionState x = given.evaluate(t), y = slow.evaluate(2 * t);
    EXPECT_DOUBLE_EQ(y[0][0], x[0][0]);
    EXPECT_DOUBLE_EQ(y[1][0], x[1][0] / 2);
    EXPECT_DOUBLE_EQ(y[4][0], x[4][0] / 16);
  }
}

TEST(SplineMotion, HigherDegreesAndOtherFaultsAreRefused) {
  EXPECT_THROW(SplineMotion({{1, {Polynomial(23)}}}), std::invalid_argument);
  EXPECT_THROW(SplineMotion({}), std::invalid_argument);
  EXPECT_THROW(SplineMotion({{1, {{0}}}, {1, {{0}}}}), std::invalid_argument);
  EXPECT_THROW(SplineMotion({{1, {{0}}}, {2, {{0}, {0}}}}), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
