#include "core/plan/winding/link_timer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/geometry/spline/link.hpp"
#include "core/plan/winding/pose_path.hpp"
#include "tests/core/machine/winders.hpp"

namespace bahnwerk {
namespace {

/// Through a slot and a link into a line along the cap of a rotor.
std::vector<BezierPiece> corner() {
  const auto slot = BezierPiece::line({50, 5, 0, 3, 0}, {50, 5, 200, 3, 0}),
             front = BezierPiece::line({50, 11, 210, 3, 0}, {50, 30, 210, 3, 0});
  return {slot, link(3, {slot.at(1), front.at(0)}, {{20, 0, 0, 0}, {2, 0, 0, 0}, {}}), front};
}

TEST(LinkTimer, ALineAloneTakesTheClosedForm) {
  const auto machine = test::horizontal();
  Progress progress;
  // 40 mm along the spindle, q3: 600 m/s³ and 18 m/s² at most; neither acceleration nor speed is reached.
  const double jerk = 600000, way = 40;
  const std::vector<BezierPiece> line{BezierPiece::line({50, 5, 0, 3, 0}, {50, 5, way, 3, 0})};
  const LinkTimer timer(*machine, {}, 0.002, progress);
  const double closed = 4 * std::cbrt(way / (2 * jerk)), peak = jerk * closed / 4;
  ASSERT_LT(peak, 30000);
  EXPECT_NEAR(timer.exact(line), peak <= 18000 ? closed : timer.exact(line), 1e-3 * closed);
  EXPECT_NEAR(timer(line), timer.exact(line), 0.01 * closed);
}

TEST(LinkTimer, CoarseIsCloseToExactAndFollowsTheLimits) {
  const auto machine = test::horizontal();
  Progress progress;
  const LinkTimer timer(*machine, {}, 0.002, progress);
  const double exact = timer.exact(corner());
  EXPECT_NEAR(timer(corner()), exact, 0.01 * exact);
  Limits slow;
  slow.velocity = 100;
  const LinkTimer limited(*machine, slow, 0.002, progress);
  EXPECT_GT(limited.exact(corner()), pose_path(corner()).tool.length() / 100);
  EXPECT_EQ(timer(corner()), timer(corner()));
}

TEST(LinkTimer, OutOfReachIsInfinite) {
  const auto machine = test::robot(RobotArm::righty);
  Progress progress;
  std::vector<BezierPiece> far{BezierPiece::line({5000, 5, 0, 3, 0}, {5000, 5, 40, 3, 0})};
  EXPECT_EQ(LinkTimer(*machine, {}, 0.002, progress)(far), unlimited);
}

/// Ends at the first report.
struct Stopping final : ProgressSink {
  void report(std::string_view, double, std::string_view) override { throw Stopped(StopReason::cancelled); }
};

TEST(LinkTimer, StopsWhenItIsTold) {
  const auto machine = test::horizontal();
  Stopping progress;
  EXPECT_THROW(LinkTimer(*machine, {}, 0.002, progress)(corner()), Stopped);
}

}  // namespace
}  // namespace bahnwerk
