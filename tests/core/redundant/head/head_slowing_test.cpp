#include "core/redundant/head/head_slowing.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/redundant/joint_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::plan;

TEST(Joint, SmallHolesAreCutAsFastAsBothAxesTogetherCan) {
  const JointTask task = test::joint_task(test::holes(4, 4, 12, 2), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r);
  EXPECT_EQ(r.slowed, 0u);
  EXPECT_EQ(r.chosen.duration, r.fastest);
}

/// The coarse axis, from rest to rest, has to go 2 strokes less than the tool.
TEST(Joint, ALongMoveLastsNoShorterThanTheCoarseAxisTakesForAllButTwoStrokes) {
  for (const double way : {300.0, 600.0, 1000.0}) {
    const JointTask task = test::joint_task(test::straight(way, 0), test::md2());
    const JointResult r = plan(task);
    expect_valid(task, r);
    const double least = (way - 40) / 1800 + 1800.0 / 16000;
    EXPECT_EQ(r.slowed, 1u);
    EXPECT_GE(r.certified, 1u);
    EXPECT_GT(r.chosen.duration, least);
    EXPECT_LT(r.chosen.duration, least * (1 + 1e-8));
  }
}

/// Coarse axes that are hardly free in anything once ended in no numbers.
TEST(Joint, MovesOverAMetreWithACircleBetweenAreFollowed) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, unlimited);
  b.line({1250, 0, 0});
  b.block(Mode::cut, 400);
  b.arc({1250, 0, 0}, {1254, 0, 0}, true);
  b.block(Mode::position, unlimited);
  b.line({0, 0, 0});
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r, 50);
  EXPECT_LT(r.chosen.duration, 1.62);
}

TEST(Joint, AMoveWithinReachIsNotSlowed) {
  // √(35/76000) s each way; two strokes are 40 mm.
  const JointTask task = test::joint_task(test::straight(35, 20), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r);
  EXPECT_EQ(r.slowed, 0u);
  EXPECT_NEAR(r.chosen.duration, 2 * std::sqrt(35.0 / 76000), 1e-6);
}

/// As long as positioning moves stay below 0.1 m what both axes can do together is reached but for 0.2 %.
TEST(Joint, ShortMovesLoseHardlyAnything) {
  Random random(13);
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    const JointTask task = test::joint_task(test::random_contour(random, 100), i % 2 == 0 ? test::md1() : test::md2());
    const JointResult r = plan(task);
    expect_valid(task, r);
    EXPECT_LE(r.chosen.duration, 1.002 * r.fastest);
  }
}

}  // namespace
}  // namespace bahnwerk
