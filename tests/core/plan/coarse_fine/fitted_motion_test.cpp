#include "core/plan/coarse_fine/fitted_motion.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

TimeLaw law(std::initializer_list<double> durations) {
  TimeLaw law;
  for (const double d : durations) law.append({0, d, 0, 1, 0, 0, 0, 0});
  return law;
}

std::shared_ptr<const Motion> spline() {
  return std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{0.5, {{1, 0, 3, 2}}}, {1, {{2, 4.5, -4.5 + 1e-9}}}});
}

TEST(FittedMotion, IsSlowedDerivativeByDerivative) {
  const FittedMotion slow(spline(), 2, law({1, 1}), {});
  EXPECT_EQ(slow.duration(), 2);
  const MotionState a = spline()->in_piece(0, 0.3), b = slow.in_piece(0, 0.6);
  EXPECT_NEAR(b.position[0], a.position[0], 1e-15);
  EXPECT_NEAR(b.velocity[0], a.velocity[0] / 2, 1e-15);
  EXPECT_NEAR(b.acceleration[0], a.acceleration[0] / 4, 1e-15);
  EXPECT_NEAR(b.jerk[0], a.jerk[0] / 8, 1e-15);
  Polynomial p;
  ASSERT_TRUE(slow.polynomial(0, 0, p));
  EXPECT_NEAR(evaluate(p, 0.6), b.position[0], 1e-15);
}

TEST(FittedMotion, BordersThatAreTheSameButForRoundingAreTheLaws) {
  const FittedMotion near(spline(), 1, law({0.5 + 1e-16, 0.5}), {});
  EXPECT_EQ(near.begin(1), law({0.5 + 1e-16, 0.5}).pieces()[1].t0);
  const FittedMotion far(spline(), 1, law({0.5 + 1e-9, 0.5}), {});
  EXPECT_EQ(far.begin(1), 0.5);
}

TEST(FittedMotion, EndsAtRest) {
  const FittedMotion velocity(spline(), 1, law({1}), {}, 1);
  EXPECT_NEAR(velocity.in_piece(1, 1).velocity[0], 0, 1e-15);
  EXPECT_EQ(velocity.in_piece(1, 0.5).velocity[0], 4.5);
  const FittedMotion both(spline(), 1, law({1}), {}, 2);
  EXPECT_NEAR(both.in_piece(1, 1).velocity[0], 0, 1e-14);
  EXPECT_NEAR(both.in_piece(1, 1).acceleration[0], 0, 1e-13);
  EXPECT_EQ(both.in_piece(1, 0.5).velocity[0], 4.5);
  EXPECT_EQ(both.in_piece(1, 0.5).acceleration[0], spline()->in_piece(1, 0.5).acceleration[0]);
  EXPECT_EQ(both.final_state().velocity[0], 0);
}

TEST(FittedMotion, AxesThatStandStillComeLast) {
  const FittedMotion motion(spline(), 1, law({1}), {7});
  ASSERT_EQ(motion.axes(), 2u);
  for (const double t : {0.1, 0.7, 1.0}) {
    const MotionState x = motion.evaluate(t);
    EXPECT_EQ(x.position[1], 7);
    EXPECT_EQ(x.velocity[1], 0);
  }
  Polynomial p;
  ASSERT_TRUE(motion.polynomial(1, 1, p));
  EXPECT_EQ(p, Polynomial{7});
}

}  // namespace
}  // namespace bahnwerk
