#include "core/plan/pipeline.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/setpoints/motion_setpoints.hpp"

namespace bahnwerk {
namespace {

/// A uniform move of 10 mm whose verifier allows a speed; it is corrected to that speed, or planned again at half.
struct Move final : MotionProblem {
  double planned = 1.0004, allowed = 100, slowed = 1;
  bool correctable = true, otherwise = false;
  int plans = 0, corrections = 0;
  Machine machine{{AxisLimits("x", unlimited)}, 0.001};
  Bound proven{0.5, 0, "made up"};

  void plan() override { ++plans; }
  bool plan_otherwise() override {
    if (!otherwise) return false;
    otherwise = false;
    planned *= 2;
    return true;
  }
  double duration() const override { return planned; }
  void slow(double factor) override { slowed = factor; }
  Verification verify() override {
    const double speed = 10 / (planned * slowed);
    Verification verdict{true, {}, {}};
    verdict.add(Check{{quantity::axis, 1, "mm", "x"}, allowed, speed, 0, speed <= allowed * (1 + 1e-12)});
    return verdict;
  }
  bool correct(const Verification& verdict) override {
    if (!correctable) return false;
    ++corrections;
    planned *= verdict.checks[0].value / verdict.checks[0].limit;
    return true;
  }
  std::shared_ptr<const Motion> motion() override {
    const double end = planned * slowed;
    return std::make_shared<const SplineMotion>(std::vector<SplineMotion::Piece>{{end, {Polynomial{0, 10 / end}}}});
  }
  std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) override {
    return std::make_unique<MotionSetpoints>(motion(), machine, cycles);
  }
  /// Counts rows; as a check it fails.
  struct Count final : RowCheck {
    std::size_t rows = 0;
    void row(std::size_t, const double*) override { ++rows; }
    std::vector<Check> checks() override {
      return {{{quantity::rows_count, 0, "1"}, 0, static_cast<double>(rows), 0, false}};
    }
  };
  std::size_t counted = 0;
  Rows row_checks(const SetpointSource&, const Verification&) override {
    Rows rows;
    rows.checks.push_back(std::make_unique<Count>());
    rows.counted = counted;
    return rows;
  }
  Bound bound() override { return proven; }
};

TEST(Pipeline, AMotionIsSlowedToWholeCyclesAndItsGapIsThatOfThePlan) {
  Progress silent;
  Move move;
  const MotionPlan plan = plan_motion(move, {}, silent);
  EXPECT_TRUE(plan.verification.passed);
  EXPECT_EQ(move.plans, 1);
  EXPECT_EQ(plan.duration, 1.0004);
  EXPECT_EQ(plan.cycles.count, 1001u);
  EXPECT_NEAR(plan.motion->duration(), 1.001, 1e-15);
  EXPECT_EQ(plan.setpoints->count(), 1002u);
  EXPECT_NEAR(plan.bound.gap, 1.0004 / 0.5 - 1, 1e-12);
}

TEST(Pipeline, WhatExceedsALimitIsCorrectedThenPlannedOtherwise) {
  Move move;
  move.allowed = 8;
  EXPECT_TRUE(verified_motion(move, {}).verification.passed);
  EXPECT_GE(move.corrections, 1);
  EXPECT_NEAR(move.planned, 1.25, 2e-3);
  Move stubborn;
  stubborn.allowed = 8, stubborn.correctable = false, stubborn.otherwise = true;
  const MotionPlan plan = verified_motion(stubborn, {});
  EXPECT_TRUE(plan.verification.passed);
  EXPECT_EQ(plan.duration, 2 * 1.0004);
  EXPECT_EQ(stubborn.plans, 1);
}

TEST(Pipeline, CorrectionsEndAndTheVerdictIsKept) {
  Move move;
  move.allowed = 1e-3;
  PipelineOptions options;
  options.max_corrections = 0;
  const MotionPlan plan = verified_motion(move, options);
  EXPECT_FALSE(plan.verification.passed);
  EXPECT_EQ(move.corrections, 0);
  EXPECT_EQ(plan.duration, 1.0004);
}

TEST(Pipeline, OnlyCountedChecksOfRowsDecideAndTheOthersAreHandedOver) {
  Progress silent;
  Move move;
  MotionPlan plan = plan_motion(move, {}, silent);
  ASSERT_EQ(plan.row_checks.size(), 1u);
  EXPECT_EQ(plan.row_checks[0]->checks()[0].value, 1002) << "every row once";
  move.counted = 1;
  plan = plan_motion(move, {}, silent);
  EXPECT_TRUE(plan.row_checks.empty());
  EXPECT_FALSE(plan.verification.passed);
}

TEST(Pipeline, APlanBelowItsBoundFailsAndTooManySetpointsAreRefusedAtTheirPlace) {
  Progress silent;
  Move move;
  move.proven.value = 1.1;
  EXPECT_FALSE(plan_motion(move, {}, silent).verification.passed);
  PipelineOptions options;
  options.max_setpoints = 1000;
  options.cycle_time_place = {"machine", "cycle"};
  try {
    plan_motion(move, options, silent);
    ADD_FAILURE() << "planned";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(error.faults[0].place, options.cycle_time_place);
  }
}

}  // namespace
}  // namespace bahnwerk
