#include "core/redundant/coarse/straight_move.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

StraightMove move_of(const JointTask& task) {
  const auto move = straight_move(*task.path, task.machine, head_limits(task.machine), unlimited, 0, 1);
  EXPECT_TRUE(move);
  return *move;
}

TEST(StraightMove, LimitsAlongALineAreThoseOfItsQuickestAxis) {
  const JointTask task = test::joint_task(test::straight(300, 400), test::md2());
  const StraightMove move = move_of(task);
  EXPECT_NEAR(move.length, 500, 1e-9);
  EXPECT_NEAR(move.fastest.feed, 3800 / 0.8, 1e-6);
  EXPECT_NEAR(move.fastest.rise, 76000 / 0.8, 1e-6);
  EXPECT_NEAR(move.slowest.feed, 1800 / 0.8, 0.1);
  EXPECT_NEAR(move.slowest.fall, 16000 / 0.8, 0.5);
  EXPECT_EQ(move.jerk_per_acceleration, unlimited);
}

TEST(StraightMove, AnArcIsNone) {
  const JointTask task = test::joint_task(test::holes(1, 1, 10, 5), test::md2());
  EXPECT_FALSE(straight_move(*task.path, task.machine, head_limits(task.machine), 400, 1, 2));
}

/// Rise, cruise and fall at the speed w: L = w²/2a + w²/2b + w t.
TEST(StraightMove, RisesAndFallsAsFastAsItsPaceSays) {
  const JointTask task = test::joint_task(test::straight(500, 0), test::md2());
  const StraightMove move = move_of(task);
  for (const double feed : {1000.0, 1e5}) {
    const Pace pace{feed, 5000, 20000};
    TimeLaw law;
    append_move(law, move, pace);
    const double w = std::min(feed, std::sqrt(2 * 500 / (1 / pace.rise + 1 / pace.fall)));
    const double cruise = (500 - w * w / 2 * (1 / pace.rise + 1 / pace.fall)) / w;
    EXPECT_NEAR(law.duration(), w / pace.rise + w / pace.fall + cruise, 1e-9);
    EXPECT_NEAR(law.pieces().back().s_end, 500, 1e-9);
    EXPECT_EQ(law.pieces().front().v, 0);
    const LawPiece& last = law.pieces().back();
    EXPECT_NEAR(last.at(last.duration).v, 0, 1e-6);
  }
}

/// Speed² is linear in the way in each part: from rest to the feed with the rise, on with the slope, and to rest with
/// the fall; with a slope below 0 the same backwards.
TEST(StraightMove, BetweenRiseAndFallSpeedChangesWithTheSlope) {
  const JointTask task = test::joint_task(test::straight(100, 0), test::md2());
  const StraightMove move = move_of(task);
  EXPECT_NEAR(move.reserve, 44000, 1e-6);
  const double rise = 70000, fall = 50000, slope = 20000, feed = 1200;
  const double on = 1 / (2 * slope), top2 = (100 - feed * feed * (0.5 / rise - on)) / (on + 0.5 / fall);
  const double top = std::sqrt(top2), expected = feed / rise + (top - feed) / slope + top / fall;
  for (const Pace& pace : {Pace{feed, rise, fall, slope}, Pace{feed, fall, rise, -slope}}) {
    TimeLaw law;
    append_move(law, move, pace);
    ASSERT_EQ(law.pieces().size(), 3u);
    EXPECT_NEAR(law.duration(), expected, 1e-12);
    EXPECT_NEAR(duration_of(move, pace), expected, 1e-12);
    for (std::size_t i = 0; i < 3; ++i) {
      const LawPiece& p = law.pieces()[i];
      const LawState end = p.at(p.duration);
      EXPECT_NEAR(end.v, i < 2 ? law.pieces()[i + 1].v : 0, 1e-9);
      EXPECT_NEAR(end.s, p.s_end, 1e-9);
    }
    EXPECT_NEAR(law.pieces()[1].a, pace.slope, 1e-6);
    EXPECT_EQ(law.pieces().back().s_end, 100);
  }
}

TEST(StraightMove, LastsAsLongAsAskedOrAsItCan) {
  const JointTask task = test::joint_task(test::straight(60, 80), test::md1());
  const StraightMove move = move_of(task);
  for (const double slope : {0.0, 0.3, -0.2}) {
    const Pace pace{1, 0.8 * move.fastest.rise, move.fastest.fall, slope * move.reserve};
    const double quickest = duration_of(move, {move.fastest.feed, pace.rise, pace.fall});
    for (const double longer : {1.01, 1.1, 1.2}) {
      const Pace found = lasting(move, pace, longer * quickest);
      EXPECT_NEAR(duration_of(move, found), longer * quickest, 1e-9);
      TimeLaw law;
      append_move(law, move, found);
      EXPECT_NEAR(law.duration(), longer * quickest, 1e-9);
      for (const LawPiece& p : law.pieces())
        EXPECT_LE(std::max(p.v, p.at(p.duration).v), move.fastest.feed * (1 + 1e-9));
    }
    EXPECT_NEAR(duration_of(move, lasting(move, pace, 0)), quickest, 1e-9);
  }
}

/// A slope above the rise would be more acceleration than allowed, and one that meets the largest speed ends there.
TEST(StraightMove, SlopesStayWithinTheLimits) {
  const JointTask task = test::joint_task(test::straight(2000, 0), test::md2());
  const StraightMove move = move_of(task);
  for (const Pace& pace : {Pace{500, 10000, 20000, 44000}, Pace{3000, 60000, 60000, 30000}, Pace{10, 900, 80, -5000}}) {
    TimeLaw law;
    append_move(law, move, pace);
    EXPECT_NEAR(law.duration(), duration_of(move, pace), 1e-9);
    for (const LawPiece& p : law.pieces()) {
      EXPECT_LE(p.a, pace.rise * (1 + 1e-9));
      EXPECT_GE(p.a, -pace.fall * (1 + 1e-9));
      EXPECT_LE(std::max(p.v, p.at(p.duration).v), move.fastest.feed * (1 + 1e-9));
    }
    EXPECT_NEAR(law.pieces().back().at(law.pieces().back().duration).v, 0, 1e-9);
  }
}

TEST(StraightMove, JerkFallsWithAcceleration) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) {
    axis.coarse.jerk = axis.coarse.acceleration / 0.01;
    axis.fine.jerk = axis.fine.acceleration / 0.005;
  }
  const JointTask task = test::joint_task(test::straight(500, 0), machine);
  const StraightMove move = move_of(task);
  EXPECT_NEAR(move.jerk_per_acceleration, 100, 0.01);
  TimeLaw law;
  append_move(law, move, {1000, 5000, 20000});
  for (const LawPiece& p : law.pieces()) {
    const bool rises = p.t0 < 0.5 * law.duration();
    EXPECT_LE(std::abs(p.j), (rises ? 5000 : 20000) * 100 * (1 + 1e-9));
    EXPECT_LE(std::abs(p.at(p.duration).a), (rises ? 5000 : 20000) * (1 + 1e-9));
  }
}

}  // namespace
}  // namespace bahnwerk
