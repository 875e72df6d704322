// The pipeline along a path of any axes: a made-up machine with five, by every method.
#include "core/plan/path_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/setpoints/path_setpoints.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/motion/axes/five_axes.hpp"

namespace bahnwerk {
namespace {

struct PathPlanFiveAxes : testing::Test {
  Contour contour = [] {
    ContourBuilder b(2, {});
    b.block(Mode::cut, 150);
    b.line({40, 0, 0});
    b.arc({60, 20, 0}, {40, 20, 0}, true);
    b.line({60, 45, 0});
    b.line({30, 45, 0});
    return b.finish();
  }();
  test::FiveAxes kinematics;
  PathPlanning planning;

  void SetUp() override {
    planning.path = planning.moving = std::make_shared<const KinematicAxisPath>(contour.path, kinematics);
    planning.feeds = planning.feeds_to_verify = contour.feeds();
    planning.rests = contour.rest_places();
  }
  void plan_by(PlanningMethod method) {
    planning.method = method_row(method);
    planning.machine = held_limits({kinematics.axes(), 0.001}, planning.method);
  }
  PathPlan plan(PlanningMethod method) {
    plan_by(method);
    Progress progress;
    PathPlan plan = plan_along(planning, progress);
    for (const Check& check : plan.verification.checks)
      EXPECT_TRUE(check.passed) << name_of<PlanningMethod>(method, planning_methods) << ": " << check_name(check) << ' '
                                << check.value << " against " << check.limit << " at " << check.at;
    EXPECT_TRUE(plan.verification.passed);
    EXPECT_LE(plan.bound.value, plan.duration);
    return plan;
  }
};

TEST_F(PathPlanFiveAxes, EveryMethodIsVerifiedAndBounded) {
  const PathPlan fast = plan(PlanningMethod::time_optimal);
  EXPECT_GE(fast.bound.gap, 0);
  EXPECT_LE(fast.bound.gap, 1e-4);  // what the bound is held to on this machine
  const PathPlan reserved = plan(PlanningMethod::braking_reserve), smooth = plan(PlanningMethod::jerk_limited);
  EXPECT_GE(reserved.duration, fast.duration * (1 - 1e-9));
  EXPECT_GE(smooth.duration, fast.duration * (1 - 1e-9));
  EXPECT_LE(smooth.duration, 3 * fast.duration);
}

TEST_F(PathPlanFiveAxes, SetpointsFollowThePathAndKeepTheLimits) {
  const PathPlan p = plan(PlanningMethod::jerk_limited);
  const SetpointSource& rows = *p.setpoints;
  ASSERT_EQ(rows.columns().size(), 17u);
  EXPECT_EQ(rows.columns()[0].name, "shoulder");
  EXPECT_EQ(rows.columns()[5].unit, "rad/s");
  EXPECT_EQ(rows.columns()[15].name, "s");
  std::vector<double> all(rows.count() * 17);
  rows.read(0, rows.count(), all.data());
  for (std::size_t k = 0; k < rows.count(); ++k) {
    const double* row = all.data() + 17 * k;
    const Vec tool = kinematics.forward({row[0], row[1], row[2], row[3], row[4]}).position;
    ASSERT_LE(norm(tool - contour.path.at(row[15]).value), 1e-7) << k;
    for (std::size_t axis = 0; axis < 5; ++axis) {
      ASSERT_LE(std::abs(row[5 + axis]), planning.machine.axes[axis].velocity * (1 + 1e-9));
      ASSERT_LE(std::abs(row[10 + axis]), planning.machine.axes[axis].acceleration * (1 + 1e-9));
    }
  }
  EXPECT_EQ(all[17 * (rows.count() - 1) + 15], contour.path.length());
}

TEST_F(PathPlanFiveAxes, DwellsLastAndCount) {
  const PathPlan before = plan(PlanningMethod::time_optimal);
  planning.dwells = {{2, 0.5, 0}};
  planning.rests[2] = true;
  const PathPlan p = plan(PlanningMethod::time_optimal);
  EXPECT_GT(p.duration, before.duration + 0.5);
  EXPECT_LE(p.bound.gap, 1e-4);
}

TEST_F(PathPlanFiveAxes, VerifiedAreTheFeedsThatWereGiven) {
  for (double& feed : planning.feeds_to_verify) feed = 20;  // the plan knows 150
  plan_by(PlanningMethod::time_optimal);
  Progress progress;
  const PathPlan p = plan_along(planning, progress);
  EXPECT_FALSE(p.verification.passed);
}

}  // namespace
}  // namespace bahnwerk
