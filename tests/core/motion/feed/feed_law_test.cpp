// Constant feeds and changes written as a law: pieces within segments, continuous, of the right length.
#include "core/motion/feed/feed_law.hpp"

#include <gtest/gtest.h>

#include "tests/core/motion/feed/feed_problem.hpp"

namespace bahnwerk {
namespace {

TEST(FeedLaw, PiecesEndWhereSegmentsDo) {
  const test::FeedProblem problem({3, 4, 5}, {0.4, -0.7}, 2);
  for (const auto& [profile, name] : speed_profiles) {
    TimeLaw law;
    FeedLawWriter writer(law, problem.tool, 0);
    const double length = problem.tool.length();
    FeedChange rise{speed_profile_row(profile).rise(30, 200, 2000), 0, 0, true},
        fall{speed_profile_row(profile).rise(30, 150, 900), 0, length, false};
    ASSERT_LT(rise.far_end(), fall.far_end());
    writer.change(rise, rise.far_end());
    writer.hold(30, fall.far_end());
    writer.change(fall, length);
    EXPECT_NEAR(law.duration(), rise.rise.duration + fall.rise.duration + (fall.far_end() - rise.far_end()) / 30, 1e-12)
        << name;
    std::size_t segment = 0;
    for (const LawPiece& piece : law.pieces()) {
      EXPECT_GE(piece.segment, segment);
      segment = piece.segment;
      EXPECT_GE(piece.s, problem.tool[segment].s0());
      EXPECT_LE(piece.s_end, problem.tool[segment].s1());
      EXPECT_NEAR(piece.at(piece.duration).s, piece.s_end, 1e-12) << name;
    }
    EXPECT_EQ(segment + 1, problem.tool.size());
    // Far above all limits of axes: only what concerns the law itself is looked at.
    test::FeedProblem fast({3, 4, 5}, {0.4, -0.7}, 2);
    for (AxisLimits& axis : fast.machine.axes) axis = {axis.name, 1e9, 1e12, 1e15};
    EXPECT_EQ(test::faults(fast, law, {}, speed_profile_row(profile).order), "") << name;
  }
}

TEST(FeedLaw, ABeginBehindTheFirstSegmentGoesOnThere) {
  const test::FeedProblem problem({3, 4}, {0.4}, 2);
  TimeLaw law;
  FeedLawWriter writer(law, problem.tool, problem.tool[1].s0());
  writer.hold(10, problem.tool.length());
  ASSERT_EQ(law.pieces().size(), 2u);
  EXPECT_EQ(law.pieces()[0].segment, 1u);
  EXPECT_EQ(law.pieces()[1].s_end, problem.tool.length());
}

}  // namespace
}  // namespace bahnwerk
