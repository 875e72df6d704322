// Profiles of a change of speed: closed forms, limits, and an independent integration.
#include "core/motion/profile/speed_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/motion/law/time_law.hpp"
#include "core/motion/profile/profile.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

/// Speed above the lower one, acceleration, jerk.
struct At {
  double v, a, j;
};
At at(const Rise& rise, double t) {
  for (const RisePiece& p : rise.pieces()) {
    if (t <= p.duration || &p == &rise.pieces().back())
      return {p.v + t * (p.a + t * (p.j / 2 + t * p.snap / 6)), p.a + t * (p.j + t * p.snap / 2), p.j + t * p.snap};
    t -= p.duration;
  }
  return {};
}

TEST(SpeedProfile, ClosedForms) {
  // A height of 100 at 200 and 1000: the ramp takes 0.2 s, the hold 0.3 s.
  EXPECT_NEAR(speed_profile_row(SpeedProfile::double_s).rise(100, 200, 1000).duration, 100 / 200.0 + 0.2, 1e-14);
  // Too low for the acceleration limit: T = 2 √(h/J), peak √(h J).
  const Rise low = speed_profile_row(SpeedProfile::double_s).rise(10, 200, 1000);
  EXPECT_NEAR(low.duration, 0.2, 1e-14);
  EXPECT_NEAR(low.acceleration, 100, 1e-10);
  EXPECT_EQ(low.count, 2u);
  EXPECT_NEAR(speed_profile_row(SpeedProfile::trapezoid).rise(100, 200, 1).duration, 0.5, 1e-14);
  // (3.105a): π h/(2 A) where the acceleration is reached, π √(h/(2 J)) where the jerk is; the cubics' jerk is 0.32 %
  // above the wave's, so that they take 0.16 % longer.
  EXPECT_NEAR(speed_profile_row(SpeedProfile::trigonometric).rise(100, 200, 1e9).duration, std::numbers::pi / 4, 1e-14);
  const double wave = std::numbers::pi * std::sqrt(100 / (2 * 1000.0));
  EXPECT_NEAR(speed_profile_row(SpeedProfile::trigonometric).rise(100, 1e9, 1000).duration / wave, 1.0016, 1e-4);
}

TEST(SpeedProfile, TheTrigonometricOneIsTheWave) {
  const Rise rise = speed_profile_row(SpeedProfile::trigonometric).rise(80, 300, 4000);
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    EXPECT_NEAR(at(rise, x * rise.duration).v, 80 * std::pow(std::sin(std::numbers::pi / 2 * x), 2), 80 * 2e-6);
  }
}

/// Continuity, limits, symmetry and distance of random rises: of heights and limits over many decades.
TEST(SpeedProfileProperty, KeepsLimitsAndAddsUp) {
  Random random(1);
  for (const auto& [profile, name] : speed_profiles) {
    const SpeedProfileRow& row = speed_profile_row(profile);
    for (int n = 0; n < testing::cases(2000); ++n) {
      const double height = std::pow(10, random.uniform(-3, 4)), A = std::pow(10, random.uniform(-3, 6)),
                   J = std::pow(10, random.uniform(-3, 8)), low = random.uniform(0, 1) < 0.3 ? 0 : height;
      const Rise rise = row.rise(height, A, J);
      ASSERT_GT(rise.count, 0u);
      double t = 0, v = 0, a = 0, s = 0;
      for (const RisePiece& p : rise.pieces()) {
        ASSERT_NEAR(p.v, v, 1e-12 * height) << name;
        ASSERT_TRUE(row.order < 3 || std::abs(p.a - a) <= 1e-9 * rise.acceleration) << name;
        // Simpson's rule is exact for the cubic speed.
        const auto speed = [&](double x) { return p.v + x * (p.a + x * (p.j / 2 + x * p.snap / 6)); };
        s += p.duration / 6 * (6 * low + speed(0) + 4 * speed(p.duration / 2) + speed(p.duration));
        for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
          const double x = part * p.duration;
          ASSERT_LE(std::abs(p.a + x * (p.j + x * p.snap / 2)), A * (1 + 1e-12)) << name;
          ASSERT_TRUE(row.order < 3 || std::abs(p.j + x * p.snap) <= J * (1 + 1e-11)) << name;
        }
        t += p.duration, v = speed(p.duration), a = p.a + p.duration * (p.j + p.duration * p.snap / 2);
      }
      ASSERT_NEAR(v, height, 1e-11 * height) << name;
      ASSERT_TRUE(row.order < 3 || std::abs(a) <= 1e-9 * rise.acceleration) << name;
      ASSERT_NEAR(t, rise.duration, 1e-12 * t) << name;
      ASSERT_NEAR(s, rise.distance(low), 1e-11 * s) << name;
      // Looser limits are never slower.
      ASSERT_LE(row.rise(height, 2 * A, J).duration, rise.duration * (1 + 1e-14)) << name;
      ASSERT_LE(row.rise(height, A, 2 * J).duration, rise.duration * (1 + 1e-14)) << name;
      ASSERT_LE(row.rise(height / 2, A, J).duration, rise.duration * (1 + 1e-14)) << name;
      // A λ-fold acceleration with a λ²-fold jerk takes 1/λ of the time.
      ASSERT_NEAR(row.rise(height, 3 * A, 9 * J).duration, rise.duration / 3, 1e-12 * rise.duration) << name;
    }
  }
}

/// The double-S is the quickest of all: that of straight moves, and no other profile is quicker.
TEST(SpeedProfileProperty, TheDoubleSIsTheQuickestUnderLimitedJerk) {
  Random random(2);
  for (int n = 0; n < testing::cases(500); ++n) {
    const double height = std::pow(10, random.uniform(-1, 3)), A = std::pow(10, random.uniform(1, 4)),
                 J = std::pow(10, random.uniform(2, 6));
    const double quickest = speed_profile_row(SpeedProfile::double_s).rise(height, A, J).duration;
    const Limits limits{unlimited, A, J, unlimited};
    EXPECT_NEAR(quickest, straight_profile(direct_distance(0, height, limits), 0, height, limits).duration,
                1e-9 * quickest);
    EXPECT_LE(quickest, speed_profile_row(SpeedProfile::trigonometric).rise(height, A, J).duration * (1 + 1e-12));
    EXPECT_GE(quickest, speed_profile_row(SpeedProfile::trapezoid).rise(height, A, J).duration * (1 - 1e-12));
  }
}

TEST(SpeedProfile, NoHeightTakesNoTime) {
  for (const auto& [profile, name] : speed_profiles) {
    const Rise rise = speed_profile_row(profile).rise(0, 100, 1000);
    EXPECT_EQ(rise.duration, 0) << name;
    EXPECT_EQ(rise.count, 0u) << name;
  }
}

}  // namespace
}  // namespace bahnwerk
