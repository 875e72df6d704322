// Motions without a path go through the same pipeline: a rise of two axes with limits up to the snap.
#include "core/plan/spline_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

constexpr double T = 0.3003;

/// x = way (35 τ⁴ − 84 τ⁵ + 70 τ⁶ − 20 τ⁷): at rest up to the jerk at both ends.
Polynomial rise(double way) {
  Polynomial p(8);
  for (const auto& [order, factor] : {std::pair{4, 35}, {5, -84}, {6, 70}, {7, -20}})
    p[static_cast<std::size_t>(order)] = way * factor / std::pow(T, order);
  return p;
}

/// The largest speed of that rise is 35/16 way/T, its largest snap 840 way/T⁴ at the ends.
SplinePlanning planning(double allowed = 1) {
  SplinePlanning given;
  given.pieces = {{T, {rise(10), rise(-4)}}};
  AxisLimits x("x", unlimited);
  x.velocity = allowed * 35.0 / 16 * 10 / T;
  x.snap = 840 * 10 / std::pow(T, 4);
  given.machine = {{x, AxisLimits("y", 100, 1e5)}, 0.001};
  given.columns = 4;
  given.bound = {0.25, 0, "made up"};
  return given;
}

TEST(SplinePlan, LastsWholeCyclesAndIsVerifiedUpToTheSnap) {
  Progress progress;
  const MotionPlan plan = plan_spline(planning(), progress);
  EXPECT_TRUE(plan.verification.passed);
  EXPECT_EQ(plan.duration, T);
  EXPECT_EQ(plan.cycles.count, 301u);
  EXPECT_NEAR(plan.motion->duration(), 0.301, 1e-15);
  const Check* snap = plan.verification.find(quantity::axis, 4, "x");
  ASSERT_NE(snap, nullptr);
  EXPECT_NEAR(snap->value, snap->limit * std::pow(T / 0.301, 4), 1e-9 * snap->limit);
  EXPECT_NE(plan.verification.find(quantity::rows, 4), nullptr);
  EXPECT_NEAR(plan.bound.gap, T / 0.25 - 1, 1e-12);
  ASSERT_EQ(plan.setpoints->columns().size(), 10u);
  EXPECT_EQ(plan.setpoints->columns()[6].name, "jx");
  EXPECT_EQ(plan.setpoints->count(), 302u);
}

TEST(SplinePlan, ExcessesByRoundingAreSlowed) {
  Progress progress;
  SplinePlanning given = planning(1 - 5e-5);
  given.machine.cycle_time = T / 256;  // no slowing to whole cycles that would do
  const MotionPlan plan = plan_spline(given, progress);
  EXPECT_TRUE(plan.verification.passed);
  EXPECT_NEAR(plan.duration, T * (1 + 5e-5), 1e-3 * T);
  EXPECT_GT(plan.duration, T);
}

TEST(SplinePlan, LargerExcessesFail) {
  Progress progress;
  const MotionPlan plan = plan_spline(planning(0.9), progress);
  EXPECT_FALSE(plan.verification.passed);
  EXPECT_FALSE(plan.verification.find(quantity::axis, 1, "x")->passed);
  EXPECT_EQ(plan.duration, T);
}

TEST(SplinePlan, TheKindsOwnChecksCount) {
  Progress progress;
  SplinePlanning given = planning();
  given.more_checks = [](const Motion& motion) {
    EXPECT_NEAR(motion.duration(), 0.301, 1e-15) << "as served";
    return std::vector<Check>{{named(CheckGroup::limit, "tube", "mm"), 1, 2, 0, false}};
  };
  const MotionPlan plan = plan_spline(given, progress);
  EXPECT_FALSE(plan.verification.passed);
}

TEST(SplinePlan, ABoundAboveThePlanFails) {
  Progress progress;
  SplinePlanning given = planning();
  given.bound.value = 0.4;
  EXPECT_FALSE(plan_spline(given, progress).verification.passed);
}

TEST(SplinePlan, TooManySetpointsAreRefused) {
  Progress progress;
  SplinePlanning given = planning();
  given.max_setpoints = 100;
  EXPECT_THROW(plan_spline(given, progress), InvalidInput);
}

}  // namespace
}  // namespace bahnwerk
