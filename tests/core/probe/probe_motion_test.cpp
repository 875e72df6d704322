#include "core/probe/probe_motion.hpp"

#include <gtest/gtest.h>

#include "core/probe/landing.hpp"

namespace bahnwerk {
namespace {

ProbeMotion two_pieces() {
  ProbeMotion m;
  m.motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{0.5, {{0, 1, 2, 3}, {1, 0, 0, 0, 4}}}, {2, {{1, 2}, {3, 1, 1}}}});
  m.times = {0, 0.75, 2};
  m.phases = {{ProbePhaseKind::accelerate, 0, 0.5, 0}, {ProbePhaseKind::turn, 0.5, 2, 1}};
  return m;
}

TEST(ProbeMotion, SlowedKeepsThePathAndDividesDerivatives) {
  const ProbeMotion m = two_pieces(), s = slowed(m, 2);
  EXPECT_EQ(s.duration(), 4);
  EXPECT_EQ(s.times, (std::vector<double>{0, 1.5, 4}));
  EXPECT_EQ(s.phases[1].begin, 1);
  EXPECT_EQ(s.phases[1].end, 4);
  for (const double t : {0.0, 0.3, 0.49, 0.5, 1.1, 2.0}) {
    const MotionState a = m.motion->evaluate(t), b = s.motion->evaluate(2 * t);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_DOUBLE_EQ(b[0][k], a[0][k]);
      EXPECT_DOUBLE_EQ(b[1][k], a[1][k] / 2);
      EXPECT_DOUBLE_EQ(b[2][k], a[2][k] / 4);
      EXPECT_DOUBLE_EQ(b[3][k], a[3][k] / 8);
      EXPECT_DOUBLE_EQ(b[4][k], a[4][k] / 16);
    }
  }
}

TEST(ProbeMotion, SlowedEndsExactlyWhereItIsTold) {
  const ProbeMotion s = slowed(two_pieces(), 1.05, 2.1);
  EXPECT_EQ(s.duration(), 2.1);
  EXPECT_EQ(s.times.back(), 2.1);
}

TEST(ProbeMotion, AnAxisThatStandsStillEndsExactlyAtRest) {
  ProbeMotion m;
  m.motion =
      std::make_shared<const SplineMotion>(std::vector<SplineMotion::Piece>{{1, {{3, 1e-310, 2e-320, -1e-315}}}});
  m.times = {0, 1};
  EXPECT_EQ(slowed(m, 1.1).motion->evaluate(1.1)[1][0], 0);
}

TEST(ProbeMotion, WhatDecaysWithinACarriedRowIsCarriedToTheEnd) {
  ProbeMotion m;
  m.motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{1, {{3, 4e-200}}}, {2, {{3, 1e-201}}}, {3, {{3, 1e-202}}}});
  m.times = {0, 3};
  m.joints = {PieceJoint::carried, PieceJoint::carried, PieceJoint::landing};
  const ProbeMotion s = slowed(m, 1.1);
  for (std::size_t i = 1; i < 3; ++i) {
    const double t = s.motion->begin(i);
    EXPECT_EQ(s.motion->in_piece(i, t)[1][0], s.motion->in_piece(i - 1, t)[1][0]) << i;
  }
}

TEST(ProbeMotion, StatesAreThoseOfSplineMotionToTheLastBit) {
  const Polynomial p{0.1, 0.7, -0.3, 1.7, 0.9, -2.3, 0.11, 5};
  const double t = 0.37;
  const MotionState x = SplineMotion({{1, {p}}}).in_piece(0, t);
  EXPECT_EQ(state_at(p, t), (std::array{x[0][0], x[1][0], x[2][0], x[3][0]}));
}

/// Late in a long motion times are rounded coarsely, and each piece is 0.01 s long.
TEST(ProbeMotion, SlowedPiecesThatAreCarriedMeetExactlyAndDoNotDriftAway) {
  constexpr std::size_t pieces = 2000;
  constexpr double h = 0.01;
  // x = t⁴ about the middle of each piece, joined to its mirror image: velocity and jerk alternate.
  const Polynomial p = shifted({0, 0, 0, 0, 1}, -h / 2, 1), q = shifted({0, 0, 0, 0, -1}, -h / 2, 1);
  const double v = state_at(p, 0)[1];
  std::vector<SplineMotion::Piece> list;
  ProbeMotion m;
  for (std::size_t i = 0; i < pieces; ++i) {
    Polynomial x = i % 2 == 0 ? p : q;
    // Velocity, acceleration and jerk at both ends are those of the next piece's begin.
    const auto end = state_at(x, h), next = state_at(i % 2 == 0 ? q : p, 0);
    const auto rest = probe::landing<double>(next[1] - end[1], next[2] - end[2], next[3] - end[3], h);
    x.resize(7, 0.0);
    for (std::size_t k = 0; k < 3; ++k) x[4 + k] += rest[k];
    list.push_back({1000 + static_cast<double>(i + 1) * h, {x}});
    m.durations.push_back(h);
    m.joints.push_back(PieceJoint::landing);
  }
  list.front().end = 1000 + h, m.durations.front() = 1000 + h, m.joints.front() = PieceJoint::exact;
  m.motion = std::make_shared<const SplineMotion>(std::move(list));
  m.times = {0, m.motion->duration()};
  const ProbeMotion s = slowed(m, 1.0001);
  for (std::size_t i = 2; i < pieces; ++i) {
    const MotionState left = s.motion->in_piece(i - 1, s.motion->begin(i)),
                      right = s.motion->in_piece(i, s.motion->begin(i));
    ASSERT_EQ(left[1][0], right[1][0]) << i;
    // Acceleration and jerk lose a bit where they are halved and divided by 6.
    ASSERT_NEAR(left[2][0], right[2][0], 4e-16 * std::abs(left[2][0])) << i;
    ASSERT_NEAR(left[3][0], right[3][0], 4e-16 * std::abs(left[3][0])) << i;
    ASSERT_NEAR(std::abs(right[1][0]), std::abs(v) / 1.0001, 1e-9 * std::abs(v)) << i;
  }
}

/// After minutes, rounding of times moves the place at which a piece comes to rest; what follows begins there.
TEST(ProbeMotion, StraightsBeginWhereThePieceBeforeThemSettles) {
  constexpr double h = 0.1, idle = 1000;
  Polynomial move{0, 0, 0, 0};
  for (const double c : probe::landing<double>(1, 0, 0, 0, h)) move.push_back(c);
  const Polynomial second = shifted(move, h / 2, 1), third{1, 0, 0, 0, 8000};
  const auto end = state_at(third, 0.02);
  ProbeMotion m;
  m.motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{idle, {{0}}},
                                       {idle + h / 2, {move}},
                                       {idle + h, {second}},
                                       {idle + h + 0.02, {third}},
                                       {idle + h + 0.06, {{end[0], end[1], end[2] / 2, end[3] / 6, -8000}}}});
  m.durations = {idle, h / 2, h / 2, 0.02, 0.04};
  m.times = {0, m.motion->duration()};
  m.joints = {PieceJoint::exact, PieceJoint::landing, PieceJoint::settling, PieceJoint::exact, PieceJoint::exact};
  double largest = 0;
  for (const double factor : {1.00013, 1.0007, 1.0011, 1.0019}) {
    const ProbeMotion s = slowed(m, factor);
    for (const std::size_t i : {3u, 4u}) {
      const double t = s.motion->begin(i);
      EXPECT_NEAR(s.motion->in_piece(i, t)[0][0], s.motion->in_piece(i - 1, t)[0][0], i == 3 ? 0 : 1e-13);
    }
    largest = std::max(largest, std::abs(s.motion->in_piece(3, s.motion->begin(3))[0][0] - 1));
  }
  EXPECT_GT(largest, 1e-14);  // it did move
  EXPECT_LT(largest, 1e-11);
}

}  // namespace
}  // namespace bahnwerk
