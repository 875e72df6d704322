#include "core/redundant/known/quicker_ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

SplineMotion standing() {
  std::vector<SplineMotion::Piece> pieces(2);
  pieces[0].end = 0.1, pieces[1].end = 0.3;
  for (SplineMotion::Piece& piece : pieces) piece.axes = {Polynomial{0}};
  return SplineMotion(std::move(pieces));
}

LawPiece piece(std::size_t segment, double s, double s_end, double v, double v_end) {
  LawPiece p;
  p.segment = segment;
  p.s = s, p.s_end = s_end, p.v = v;
  p.duration = 2 * (s_end - s) / (v + v_end);
  p.a = (v_end - v) / p.duration;
  return p;
}

/// The rate rises from 0 to 2 on 40 ms, stays on 80 ms, over the border of both intervals, falls to a half on 60 ms,
/// and is 1.5 at the end.
TEST(QuickerRanges, AreWhereTheOldTimeWouldBeSlower) {
  TimeLaw rate;
  rate.append(piece(0, 0, 40, 0, 2000));
  rate.append(piece(0, 40, 100, 2000, 2000));
  rate.append(piece(1, 100, 120, 2000, 2000));
  rate.append(piece(1, 120, 180, 2000, 500));
  rate.append(piece(1, 180, 280, 500, 500));
  rate.append(piece(1, 280, 300, 1500, 1500));
  const std::vector<QuickerRange> ranges = quicker_ranges(rate);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].begin, 10, 1e-9);  // v² rises evenly along the way
  EXPECT_NEAR(ranges[0].end, 168, 1e-9);
  EXPECT_EQ(ranges[0].pieces.size(), 4u);
  EXPECT_EQ(ranges[1].begin, 280);
  EXPECT_EQ(ranges[1].end, 300);

  const SplineMotion head = standing(), coarse = standing();
  std::vector<TimedPath::SmoothInterval> intervals = TimedPath::smooth_intervals(head, coarse);
  const Path tool = TimedPath::tool_path(intervals);
  const TimedPath path(tool, head, coarse, std::move(intervals));
  std::vector<std::size_t> borders;
  const TimeLaw law = with_ranges(path, ranges, borders);
  ASSERT_EQ(borders.size(), 4u);
  double s = 0, v = 0;
  for (std::size_t i = 0; i < law.pieces().size(); ++i) {
    const LawPiece& p = law.pieces()[i];
    EXPECT_NEAR(p.s, s, 1e-12);
    if (i > 0 && i != borders[2]) {
      EXPECT_NEAR(p.v, v, 1e-6);
    }
    EXPECT_GE(p.v, 1000 * (1 - 1e-9));
    s = p.s_end, v = p.at(p.duration).v;
    EXPECT_NEAR(p.at(p.duration).s, s, 1e-9);
    EXPECT_GE(p.s, path[p.segment].s0());
    EXPECT_LE(p.s_end, path[p.segment].s1());
  }
  EXPECT_NEAR(s, 300, 1e-12);
  EXPECT_EQ(law.pieces()[borders[0]].s, ranges[0].begin);
  EXPECT_EQ(law.pieces()[borders[1]].s, ranges[0].end);
  EXPECT_EQ(borders[3], law.pieces().size());
  const double rising = 2 * 30.0 / 3000, falling = 2 * 48.0 / 3000;
  EXPECT_NEAR(law.duration(), 0.01 + rising + 80.0 / 2000 + falling + 112.0 / 1000 + 20.0 / 1500, 1e-12);
}

/// Of a rate that is above 1 on a hundredth of a piece the piece is taken whole.
TEST(QuickerRanges, APartThatIsTooShortTakesItsPiece) {
  TimeLaw rate;
  rate.append(piece(0, 0, 100, 0, 1000 / std::sqrt(0.99)));
  rate.append(piece(1, 100, 300, 1000 / std::sqrt(0.99), 1500));
  const std::vector<QuickerRange> ranges = quicker_ranges(rate);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].begin, 0);
  const LawPiece& first = ranges[0].pieces.front();
  EXPECT_EQ(first.v, 1000);
  EXPECT_NEAR(first.at(first.duration).v, rate.pieces()[1].v, 1e-9);
  EXPECT_NEAR(first.at(first.duration).s, 100, 1e-9);
}

TEST(QuickerRanges, WithNoneTheOldTimeGoesOn) {
  const SplineMotion head = standing(), coarse = standing();
  std::vector<TimedPath::SmoothInterval> intervals = TimedPath::smooth_intervals(head, coarse);
  const Path tool = TimedPath::tool_path(intervals);
  const TimedPath path(tool, head, coarse, std::move(intervals));
  std::vector<std::size_t> borders;
  const TimeLaw law = with_ranges(path, {}, borders);
  EXPECT_NEAR(law.duration(), 0.3, 1e-12);
  EXPECT_EQ(law.pieces().size(), 2u);
}

}  // namespace
}  // namespace bahnwerk
