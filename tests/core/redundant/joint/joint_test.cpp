#include "core/redundant/joint/joint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/redundant/joint_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::plan, test::random_machine;

TEST(Joint, OneHoleInsideTheStrokeHardlyMovesTheCoarseAxes) {
  ContourBuilder b(2, {5, 0, 0});
  b.block(Mode::cut, 300);  // 300²/5 = 18 000 mm/s²: the fine axes can do that alone
  b.arc({5, 0, 0}, {0, 0, 0}, true);
  const JointTask task = test::joint_task(b.finish(), test::md2());
  const JointResult r = plan(task);
  expect_valid(task, r);
  EXPECT_EQ(r.chosen.duration, r.fastest);
  for (int i = 0; i <= 100; ++i) {  // what moves it are the few milliseconds in which the head uses both axes fully
    const MotionState x = r.coarse->evaluate(r.chosen.duration * i / 100);
    EXPECT_LT(std::abs(x[0][0] - r.coarse->evaluate(0)[0][0]), 5);
  }
}

/// Cells as short as such strokes ask for would be millions.
TEST(Joint, HasNoPlanForStrokesOfAMicrometre) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.stroke = 0.001;
  Progress progress;
  const Expected<JointResult, NoPlan> r = plan_joint(test::joint_task(test::holes(2, 2, 40, 3), machine), {}, progress);
  ASSERT_FALSE(r);
  EXPECT_EQ(r.reason(), NoPlan::no_fine_axis);
}

TEST(Joint, AMoveAtASlowFeedHoldsItWithALargeStroke) {
  const CoarseFineAxis axis{"x", {1800, 16000, 3418851.8}, {2000, 60000, 15370936.3}, 25};
  CoarseFineMachine machine{{axis, axis}, 0.001};
  machine.axes[1].name = "y";
  const JointTask task = test::joint_task(test::straight(48.2996, 48.2996, 19.446867615109927), machine);
  const JointResult r = plan(task);
  expect_valid(task, r, 50);
  EXPECT_LT(r.chosen.duration, 3.5142);
}

/// What the coarse axes can do by themselves is always there, the fine ones standing still.
TEST(Joint, RandomContoursOnRandomMachinesHoldAllLimits) {
  Random random(11);
  std::size_t slowed = 0;
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    const JointTask task = test::joint_task(test::random_contour(random, 400), random_machine(random));
    JointOptions options;
    options.smoothness = i % 3 == 0 ? random.uniform() : 0;
    const JointResult r = plan(task, options);
    expect_valid(task, r);
    slowed += r.slowed;
    EXPECT_GE(r.chosen.duration, r.fastest * stretch_of(options.smoothness) * (1 - 1e-12));
  }
  EXPECT_GT(slowed, 3u);
}

TEST(Joint, LimitedJerkIsHeldToo) {
  Random random(12);
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    CoarseFineMachine machine = random_machine(random);
    for (CoarseFineAxis& axis : machine.axes) {
      axis.coarse.jerk = axis.coarse.acceleration / random.uniform(0.002, 0.02);
      axis.fine.jerk = axis.fine.acceleration / random.uniform(0.002, 0.02);
    }
    const JointTask task = test::joint_task(test::random_contour(random, 60), machine);
    const JointResult r = plan(task);
    expect_valid(task, r);
    EXPECT_LE(r.chosen.duration, 1.3 * r.fastest);
  }
}

/// Pieces of the head's law are short there, and between some its jerk goes from one end of its limits to the other.
TEST(Joint, LimitedJerkAlongFreeShapes) {
  Random random(15);
  for (const double per_second : {100.0, 400.0})
    for (const CoarseFineMachine& machine : {test::md1(), test::md2()})
      for (int i = 0; i < 2; ++i) {
        SCOPED_TRACE(std::to_string(per_second) + " " + std::to_string(i));
        std::vector<double> radii;
        for (int k = 0; k < 8; ++k) radii.push_back(random.uniform(2.5, 4));
        const JointTask task = test::joint_task(test::free_shape(radii, 400), test::with_jerk(machine, per_second));
        const JointResult r = plan(task);
        expect_valid(task, r);
        EXPECT_LE(r.chosen.duration, 1.002 * r.fastest);
      }
}

/// Where curvature jumps the head's acceleration does, too: the fine axes have to take that.
TEST(Joint, LimitedJerkAlongSlots) {
  for (const double per_second : {100.0, 400.0})
    for (const double radius : {0.5, 2.0, 10.0}) {
      SCOPED_TRACE(std::to_string(per_second) + " " + std::to_string(radius));
      const JointTask task =
          test::joint_task(test::slot(2 * radius, radius, 500), test::with_jerk(test::md2(), per_second));
      const JointResult r = plan(task);
      expect_valid(task, r);
      EXPECT_LE(r.chosen.duration, 1.002 * r.fastest);
    }
}

TEST(Joint, JerkOfSomeAxesOnlyIsRefused) {
  CoarseFineMachine machine = test::md2();
  machine.axes[0].coarse.jerk = 1e6;
  EXPECT_THROW(plan(test::joint_task(test::straight(10, 0), machine)), std::invalid_argument);
}

TEST(Joint, StopsWhenToldTo) {
  struct Stop final : ProgressSink {
    void report(std::string_view, double, std::string_view) override {
      if (++calls == 20) throw Stopped(StopReason::cancelled);
    }
    int calls = 0;
  } stop;
  EXPECT_THROW(plan_joint(test::joint_task(test::holes(4, 4, 40, 8), test::md2()), {}, stop), Stopped);
}

}  // namespace
}  // namespace bahnwerk
