#include "core/motion/profile/profile_pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

/// From v0 over w to v1 by the quickest changes of speed.
Profile laid(double v0, double w, double v1, double distance, const ProfileLimits& limits) {
  Profile p;
  p.start_speed = v0, p.turning_speed = w, p.end_speed = v1, p.distance = distance;
  const SpeedChangeLaw law(limits.acceleration, limits.jerk, limits.snap);
  lay_pieces(p, law.shape(std::abs(w - v0)), law.shape(std::abs(w - v1)), limits);
  return p;
}

/// Every piece goes on in the state in which the one before ends; accelerations jump where no jerk is limited.
void expect_joined(const Profile& p, double v0, double v1, double step = 1e-11) {
  ProfileState at{0, v0, 0, 0, 0};
  double t = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    const ProfilePiece& piece = p.piece[i];
    EXPECT_NEAR(piece.t0, t, 1e-14) << i;
    EXPECT_NEAR(piece.s, at.s, 1e-12) << i;
    EXPECT_NEAR(piece.v, at.v, 1e-12) << i;
    EXPECT_NEAR(piece.a, at.a, step) << i;
    at = piece.at(piece.duration);
    t += piece.duration;
  }
  EXPECT_NEAR(at.s, p.distance, 1e-12);
  EXPECT_NEAR(at.v, v1, 1e-12);
  EXPECT_NEAR(at.a, 0, step);
  EXPECT_NEAR(p.duration, t, 1e-14);
}

TEST(ProfilePieces, ADoubleSHasSevenWithItsHoldInTheMiddle) {
  const ProfileLimits limits{2, 4, 16, unlimited};  // 0.75 s and 0.75 mm for each change
  const Profile p = laid(0, 2, 0, 3.5, limits);
  EXPECT_EQ(p.count, 7u);
  EXPECT_NEAR(p.duration, 0.75 + 1 + 0.75, 1e-14);
  EXPECT_EQ(p.piece[3].a, 0);
  EXPECT_NEAR(p.piece[3].duration, 1, 1e-14);
  EXPECT_DOUBLE_EQ(p.peak_acceleration, 4);
  EXPECT_DOUBLE_EQ(p.peak_jerk, 16);
  expect_joined(p, 0, 0);
}

TEST(ProfilePieces, ASpeedBelowTheLimitIsNotHeldAndADipComesBack) {
  const ProfileLimits limits{10, 4, unlimited, unlimited};
  const Profile peak = laid(1, 3, 2, (9 - 1) / 8.0 + (9 - 4) / 8.0, limits);
  EXPECT_EQ(peak.count, 2u);
  EXPECT_EQ(peak.peak_speed, 3);
  expect_joined(peak, 1, 2, 8);
  const Profile dip = laid(3, 1, 2, (9 - 1) / 8.0 + (4 - 1) / 8.0, limits);
  EXPECT_EQ(dip.piece[0].a, -4);
  EXPECT_EQ(dip.piece[1].v, 1);
  EXPECT_EQ(dip.peak_speed, 3);
  expect_joined(dip, 3, 2, 8);
}

TEST(ProfilePieces, WithLimitedSnapThereAreFifteen) {
  const ProfileLimits limits{2, 4, 16, 256};
  const SpeedChangeLaw law(4, 16, 256);
  const Profile p = laid(0, 2, 0, 2 * law.duration(2) + 1, limits);
  EXPECT_EQ(p.count, 15u);
  expect_joined(p, 0, 0);
}

}  // namespace
}  // namespace bahnwerk
