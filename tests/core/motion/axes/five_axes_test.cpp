// A machine with five axes, and machines with one to eight, planned by every method: limits of each axis hold between
// the nodes, and are used.
#include "five_axes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bow.hpp"
#include "coordinate_axes.hpp"
#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/jerk/jerk_limited.hpp"

namespace bahnwerk {
namespace {

using test::bow;

struct Peaks {
  AxisArray velocity{}, acceleration{}, jerk{};  // as parts of the limits
  double busiest = 0;                            // smallest, over time, of the largest part that any limit is used to
};

/// By dense sampling of the finished law: nothing of the planner is used.
Peaks peaks(const AxisPath& path, const Machine& machine, const TimeLaw& law, bool jerk) {
  Peaks p;
  p.busiest = 1;
  for (const LawPiece& piece : law.pieces()) {
    const int n = std::clamp(static_cast<int>(piece.duration / 2e-5), 4, 4000);
    for (int i = 0; i <= n; ++i) {
      const LawState x = piece.at(piece.duration * i / n);
      const AxisJet q = path.at(piece.segment, std::clamp(x.s, piece.s, piece.s_end));
      double used = 0;
      for (std::size_t k = 0; k < path.axes(); ++k) {
        const AxisLimits& limit = machine.axes[k];
        const double v = std::abs(q.d1[k] * x.v) / limit.velocity,
                     a = std::abs(q.d2[k] * x.v * x.v + q.d1[k] * x.a) / limit.acceleration,
                     j = std::abs(q.d3[k] * x.v * x.v * x.v + 3 * q.d2[k] * x.v * x.a + q.d1[k] * x.j) / limit.jerk;
        p.velocity[k] = std::max(p.velocity[k], v);
        p.acceleration[k] = std::max(p.acceleration[k], a);
        p.jerk[k] = std::max(p.jerk[k], j);
        used = std::max({used, v, a, jerk ? j : 0});
      }
      p.busiest = std::min(p.busiest, used);
    }
  }
  return p;
}

void holds(const Peaks& p, std::size_t axes, bool jerk) {
  for (std::size_t k = 0; k < axes; ++k) {
    EXPECT_LE(p.velocity[k], 1 + 1e-9) << "axis " << k;
    EXPECT_LE(p.acceleration[k], 1 + 1e-8) << "axis " << k;
    if (jerk) {
      EXPECT_LE(p.jerk[k], 1 + 1e-8) << "axis " << k;
    }
  }
}

struct FiveAxes : testing::Test {
  const Contour contour = bow();
  const test::FiveAxes kinematics;
  const Machine machine{kinematics.axes(), 0.001};
  const KinematicAxisPath path{contour.path, kinematics};
  const PathTask task = contour_task(path, contour, machine);
  Progress progress;
};

TEST_F(FiveAxes, TimeOptimalUsesSomeLimitAllTheTime) {
  const TimeLaw law = plan_acceleration_limited(task, {}, progress).law;
  const Peaks p = peaks(path, machine, law, false);
  holds(p, 5, false);
  EXPECT_GT(p.busiest, 0.98);  // bang-bang, up to the cells in which it switches
}

TEST_F(FiveAxes, TheReserveIsKeptAndCostsTime) {
  AccelerationLimitedOptions reserve;
  reserve.keep_reserve = true;
  const TimeLaw law = plan_acceleration_limited(task, reserve, progress).law;
  holds(peaks(path, machine, law, false), 5, false);
  EXPECT_GE(law.duration(), plan_acceleration_limited(task, {}, progress).law.duration());
}

TEST_F(FiveAxes, JerkLimitedHoldsEveryJerk) {
  const TimeLaw law = plan_jerk_limited(task, {}, progress).law;
  holds(peaks(path, machine, law, true), 5, true);
  const double quick = plan_acceleration_limited(task, {}, progress).law.duration();
  EXPECT_GE(law.duration(), quick * (1 - 1e-6));
  Machine looser = machine;
  for (AxisLimits& axis : looser.axes) axis.jerk *= 1000;
  const TimeLaw loose = plan_jerk_limited(contour_task(path, contour, looser), {}, progress).law;
  EXPECT_LT(loose.duration(), quick * 1.02);  // what jerk costs vanishes with it
}

constexpr Limits coordinate{900, 9000, 600000};  // of x and of y

/// Units and repeated axes change nothing: x and y through kinematics are x and y.
TEST(ManyAxes, TwoToEightPlanLikeTheCoordinatesTheyAre) {
  const Contour contour = bow();
  Progress progress;
  Machine two;
  two.axes = {{"x", 900, 9000, 600000}, {"y", 900, 9000, 600000}};
  const double quick = plan_acceleration_limited(contour, two, {}, progress).law.duration(),
               smooth = plan_jerk_limited(contour, two, {}, progress).law.duration();
  for (std::size_t axes = 2; axes <= max_axes; ++axes) {  // where x alone would stand still nothing limits the motion
    const test::CoordinateAxes kinematics(axes, coordinate, coordinate, 1);
    const Machine machine{kinematics.axes(), 0.001};
    const KinematicAxisPath path(contour.path, kinematics);
    const PathTask task = contour_task(path, contour, machine);
    const TimeLaw law = plan_acceleration_limited(task, {}, progress).law;
    holds(peaks(path, machine, law, false), axes, false);
    EXPECT_NEAR(law.duration(), quick, 1e-5 * quick) << axes;
    const TimeLaw gentle = plan_jerk_limited(task, {}, progress).law;
    holds(peaks(path, machine, gentle, true), axes, true);
    EXPECT_NEAR(gentle.duration(), smooth, 2e-3 * smooth) << axes;
  }
}

/// One axis that never stands: the rest-to-rest motion over a given way has a closed form.
TEST(ManyAxes, OneAxisAlongALineTakesTheClosedForm) {
  ContourBuilder b(2, {});
  b.line({40, 30, 0});
  const Contour contour = b.finish();
  const test::CoordinateAxes kinematics(1, coordinate, coordinate, 1);
  const Machine machine{kinematics.axes(), 0.001};
  const KinematicAxisPath path(contour.path, kinematics);
  Progress progress;
  const TimeLaw law = plan_acceleration_limited(contour_task(path, contour, machine), {}, progress).law;
  // 40 mm of x at 9000 mm/s²; √(40·9000) = 600 mm/s stays below its limit of 900.
  EXPECT_NEAR(law.duration(), 2 * std::sqrt(40.0 / 9000), 1e-6);
}

}  // namespace
}  // namespace bahnwerk
