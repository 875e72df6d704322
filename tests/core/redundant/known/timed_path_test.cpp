#include "core/redundant/known/timed_path.hpp"

#include <gtest/gtest.h>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

struct Timed {
  /// x = t³ for 0.3 s, then on with that state; the coarse axis goes evenly, and its pieces meet at 0.1 s.
  SplineMotion head = SplineMotion({{0.3, {Polynomial{0, 0, 0, 1}}}, {0.5, {Polynomial{0.027, 0.27, 0.9}}}});
  SplineMotion coarse = SplineMotion({{0.1, {Polynomial{0, 0.5}}}, {0.5, {Polynomial{0.05, 0.5, 2}}}});
  std::vector<TimedPath::SmoothInterval> intervals = TimedPath::smooth_intervals(head, coarse);
  Path tool = TimedPath::tool_path(intervals);
  TimedPath path{tool, head, coarse, intervals};
};

TEST(TimedPath, ItsSegmentsAreTheIntervalsInWhichBothMotionsAreSmooth) {
  const Timed timed;
  ASSERT_EQ(timed.intervals.size(), 3u);
  EXPECT_EQ(timed.intervals[1].begin, 0.1);
  EXPECT_EQ(timed.intervals[1].end, 0.3);
  EXPECT_EQ(timed.intervals[1].head, 0u);
  EXPECT_EQ(timed.intervals[1].coarse, 1u);
  EXPECT_EQ(timed.path.axes(), 2u);
  EXPECT_NEAR(timed.path.length(), 500, 1e-9) << "1 mm for 1 ms";
  EXPECT_NEAR(timed.path[2].s0(), 300, 1e-9);
}

TEST(TimedPath, DerivativesByPathLengthAreThoseByTimeInMilliseconds) {
  const Timed timed;
  const double t = 0.2, since = 0.1;
  const AxisJet q = timed.path.at_parameter(1, 0.5);
  const double c = 0.05 + 0.5 * since + 2 * since * since, vc = 0.5 + 4 * since;
  EXPECT_NEAR(q.value[0], c, 1e-15);
  EXPECT_NEAR(q.value[1], t * t * t - c, 1e-15);
  EXPECT_NEAR(q.d1[0], 1e-3 * vc, 1e-16);
  EXPECT_NEAR(q.d1[1], 1e-3 * (3 * t * t - vc), 1e-16);
  EXPECT_NEAR(q.d2[0], 1e-6 * 4, 1e-18);
  EXPECT_NEAR(q.d2[1], 1e-6 * (6 * t - 4), 1e-18);
  EXPECT_NEAR(q.d3[1], 1e-9 * 6, 1e-20);
}

TEST(TimedPath, IntervalsShorterThanRoundingAreLeftOut) {
  const SplineMotion head({{0.25, {Polynomial{0}}}, {1, {Polynomial{0}}}});
  const SplineMotion coarse({{0.25 + 1e-13, {Polynomial{0}}}, {1, {Polynomial{0}}}});
  const auto intervals = TimedPath::smooth_intervals(head, coarse);
  ASSERT_EQ(intervals.size(), 2u);
  EXPECT_EQ(intervals[1].head, 1u);
  EXPECT_EQ(intervals[1].coarse, 1u);
}

}  // namespace
}  // namespace bahnwerk
