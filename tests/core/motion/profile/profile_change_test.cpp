#include "core/motion/profile/profile_change.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/profile/profile.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

double magnitude(Random& random) { return std::exp(random.uniform(std::log(1e-6), std::log(1e6))); }
double maybe(Random& random) { return random.chance(0.15) ? unlimited : magnitude(random); }

TEST(SpeedChangeLaw, AgreesWithValuesComputedByHand) {
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(5, unlimited, unlimited).duration(10), 2);
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(5, 20, unlimited).duration(10), 10 / 5. + 5 / 20.);
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(5, 20, unlimited).duration(1), 2 * std::sqrt(1 / 20.));
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(5, 20, 100).duration(10), 10 / 5. + 5 / 20. + 20 / 100.);
  // a = S τ², d = 2 S τ³ with four ramps of τ.
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(unlimited, unlimited, 100).duration(2 * 100 * 0.027), 4 * 0.3);
  // The jerk limit just reached: τ = J/S.
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(unlimited, 20, 100).duration(2 * 100 * 0.008), 4 * 0.2);
  EXPECT_DOUBLE_EQ(SpeedChangeLaw(9, unlimited, unlimited).duration(0), 0);
}

/// The change is the rest-to-rest move of the acceleration: two codes, one number.
TEST(SpeedChangeLaw, IsTheMoveOneDerivativeUp) {
  Random random(31);
  for (int run = 0; run < 20000; ++run) {
    const double A = maybe(random), J = maybe(random), S = magnitude(random), d = magnitude(random);
    const double T = SpeedChangeLaw(A, J, S).duration(d);
    ASSERT_NEAR(straight_profile(d, 0, 0, {A, J, S, unlimited}).duration, T, 2e-14 * T) << run;
  }
}

TEST(SpeedChangeLaw, InverseAndSlopes) {
  Random random(32);
  for (int run = 0; run < 20000; ++run) {
    const double A = maybe(random), J = maybe(random), S = maybe(random), d = magnitude(random);
    if (A == unlimited && J == unlimited && S == unlimited) continue;
    const SpeedChangeLaw law(A, J, S);
    const double T = law.duration(d);
    // T ≈ θ(A) where little of the height counts: what rounding of T makes of d.
    const double rounding = 4e-16 * T * law.height_slope(T);
    ASSERT_NEAR(law.height(T), d, 1e-14 * d + rounding) << run;
    ASSERT_NEAR(law.slope(d) * law.height_slope(law.duration(d)), 1, 1e-10) << run;
    const double h = 1e-5 * d, numeric = (law.duration(d + h) - law.duration(d - h)) / (2 * h);
    if (std::abs(d - law.full_height()) > 2 * h) {
      ASSERT_NEAR(law.slope(d), numeric, 1e-7 * numeric + 1e-15 * T / h) << run;
    }
  }
}

TEST(SpeedChangeLaw, ShapeAddsUp) {
  Random random(33);
  for (int run = 0; run < 20000; ++run) {
    const double A = maybe(random), J = maybe(random), S = maybe(random), d = magnitude(random);
    if (A == unlimited && J == unlimited && S == unlimited) continue;
    const SpeedChangeLaw law(A, J, S);
    const SpeedChange c = law.shape(d);
    const double rise = 2 * c.ramp + c.jerk_hold;
    ASSERT_NEAR(2 * rise + c.hold, law.duration(d), 1e-14 * law.duration(d)) << run;
    ASSERT_NEAR(c.acceleration * (rise + c.hold), d, 1e-14 * d) << run;
    ASSERT_LE(c.acceleration, A * (1 + 1e-15));
    ASSERT_GE(c.jerk_hold, 0);
    ASSERT_GE(c.hold, 0);
    if (rise > 0) {
      ASSERT_NEAR(c.jerk * (c.ramp + c.jerk_hold), c.acceleration, 1e-14 * c.acceleration) << run;
      ASSERT_LE(c.jerk, J * (1 + 1e-15));
    }
    if (c.ramp > 0) {
      ASSERT_NEAR(c.jerk / c.ramp, S, 1e-14 * S) << run;
    }
  }
}

TEST(SpeedChangeLaw, HasNoPhasesWithoutHeight) {
  const SpeedChange c = SpeedChangeLaw(5, unlimited, unlimited).shape(0);
  EXPECT_EQ(c.hold, 0);
  EXPECT_EQ(c.acceleration, 0);
  EXPECT_EQ(c.jerk, 0);
}

}  // namespace
}  // namespace bahnwerk
