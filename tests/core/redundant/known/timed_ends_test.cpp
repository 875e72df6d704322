#include "core/redundant/known/timed_ends.hpp"

#include <gtest/gtest.h>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {
namespace {

/// One axis, 0.5 mm up and 0.5 mm down its speed in 0.1 s each, its acceleration a quarter of what is allowed: twice as
/// fast is possible all along, at both ends, too.
TEST(TimedEnds, TheOldTimeGoesOnWhereAllAxesStand) {
  std::vector<SplineMotion::Piece> up(2);
  up[0].end = 0.1, up[0].axes = {Polynomial{0, 0, 50}};
  up[1].end = 0.2, up[1].axes = {Polynomial{0.5, 10, -50}};
  const SplineMotion motion(std::move(up)), still([] {
    std::vector<SplineMotion::Piece> pieces(1);
    pieces[0].end = 0.2, pieces[0].axes = {Polynomial{0}};
    return pieces;
  }());
  std::vector<TimedPath::SmoothInterval> intervals = TimedPath::smooth_intervals(motion, still);
  ASSERT_EQ(intervals.size(), 2u);
  const Path tool = TimedPath::tool_path(intervals);
  const TimedPath path(tool, motion, still, std::move(intervals));
  Machine axes;
  axes.axes = {AxisLimits("xc", 100, 400), AxisLimits("xf", 100, 400)};
  // As a planner writes it: from rest to twice the old time and back, mm of 1 ms.
  TimeLaw rate;
  const double ends[] = {0, 4, 100, 196, 200};
  for (int i = 0; i < 4; ++i) {
    LawPiece p;
    p.segment = i < 2 ? 0 : 1;
    p.s = ends[i], p.s_end = ends[i + 1];
    p.v = i == 0 ? 0 : 2000;
    p.a = i == 0 ? 500e3 : i == 3 ? -500e3 : 0;
    p.duration = i == 0 || i == 3 ? 4e-3 : 96.0 / 2000;
    rate.append(p);
  }
  const TimeLaw moving = with_moving_ends(rate, path, axes);
  EXPECT_NEAR(rate.duration(), 0.104, 1e-12);
  EXPECT_NEAR(moving.duration(), 0.1, 1e-12);
  axes.axes[1].acceleration = 399;  // not quite as fast: the ends stay as they are
  EXPECT_NEAR(with_moving_ends(rate, path, axes).duration(), 0.104, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
