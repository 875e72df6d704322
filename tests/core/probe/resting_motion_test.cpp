#include "core/probe/resting_motion.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(RestingMotion, EndsAtRestWhereItIsTold) {
  const auto spline = std::make_shared<const SplineMotion>(std::vector<SplineMotion::Piece>{
      {0.5, {Polynomial{0, 1}, Polynomial{0}}}, {1, {Polynomial{0.5, 1, -1, 1e-17}, Polynomial{0, 0, 3}}}});
  const RestingMotion motion(spline, {0.75, 0.8});
  EXPECT_EQ(motion.axes(), 2u);
  EXPECT_EQ(motion.duration(), 1);
  for (const double t : {0.0, 0.3, 0.7})
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(motion.evaluate(t)[0][k], spline->evaluate(t)[0][k]);
      EXPECT_EQ(motion.evaluate(t)[1][k], spline->evaluate(t)[1][k]);
    }
  const MotionState end = motion.final_state();
  EXPECT_EQ(end[0][0], 0.75);
  EXPECT_EQ(end[0][1], 0.8);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(end[1][k], 0);
    EXPECT_EQ(end[2][k], 0);
    EXPECT_EQ(end[3][k], 0);
  }
}

}  // namespace
}  // namespace bahnwerk
