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

TEST(StraightMove, LastsAsLongAsAskedOrAsItCan) {
  const JointTask task = test::joint_task(test::straight(60, 80), test::md1());
  const StraightMove move = move_of(task);
  for (const double share : {1.0, 0.8, 0.1}) {
    const Pace pace{1, share * move.fastest.rise, move.fastest.fall};
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
