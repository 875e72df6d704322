#include "core/plan/contour/contour_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"

namespace bahnwerk {
namespace {

/// Two lines that meet at `angle`, rad: 3 mm cut in 1.5 s, then 4 mm positioned in 1 s.
struct Driven {
  explicit Driven(double angle) {
    ContourBuilder b(2, {});
    b.block(Mode::cut, 2);
    b.line({3, 0, 0});
    b.block(Mode::position, 4);
    b.line({3 + 4 * std::cos(angle), 4 * std::sin(angle), 0});
    contour = b.finish();
    const double middle = contour.path[0].s1(), end = contour.path[1].s1();
    law.append({0, 1.5, 0, middle, 2, 0, 0, 0, 0});
    law.append({0, 1, middle, end, 4, 0, 0, 1, 0});
  }
  Contour contour;
  TimeLaw law;
};

TEST(ContourReport, BlocksLastAsInTheSampledMotionAndSumsAreThoseOfThePlan) {
  const Driven driven(0.1);
  ContourPlan plan;
  report_blocks(driven.contour, {driven.law, 1.25}, plan);
  ASSERT_EQ(plan.blocks.size(), 2u);
  EXPECT_EQ(plan.blocks[0].mode, Mode::cut);
  EXPECT_DOUBLE_EQ(plan.blocks[0].end_time, 1.5);
  EXPECT_DOUBLE_EQ(plan.blocks[1].start_time, 1.5);
  EXPECT_DOUBLE_EQ(plan.blocks[1].end_time, 2.5);
  EXPECT_DOUBLE_EQ(plan.blocks[0].length, 3);
  EXPECT_NEAR(plan.blocks[1].length, 4, 1e-14);
  EXPECT_DOUBLE_EQ(plan.cut_time, 1.5 / 1.25);
  EXPECT_DOUBLE_EQ(plan.position_time, 1 / 1.25);
}

TEST(ContourReport, TangentJumpsBelowTheCornerAngleAreReportedWithTheirSpeedStep) {
  const double angle = 0.01;
  const Driven driven(angle);
  Progress silent;
  ContourPlan plan;
  report_joints(driven.contour, 2, {driven.law, 1.5}, 0.02, plan, silent);
  ASSERT_EQ(plan.joints.size(), 1u);
  EXPECT_DOUBLE_EQ(plan.joints[0].s, 3);
  EXPECT_NEAR(plan.joints[0].angle, angle, 1e-12);
  EXPECT_DOUBLE_EQ(plan.joints[0].velocity, 1.5 * 4);
  ASSERT_EQ(plan.joints[0].step.size(), 2u);
  EXPECT_NEAR(plan.joints[0].step[0], 6 * (std::cos(angle) - 1), 1e-12);
  EXPECT_NEAR(plan.joints[0].step[1], 6 * std::sin(angle), 1e-12);
  ContourPlan corner, rounding;
  report_joints(driven.contour, 2, {driven.law, 1}, 0.005, corner, silent);
  EXPECT_TRUE(corner.joints.empty()) << "the head stops at corners";
  const Driven straight(1e-10);
  report_joints(straight.contour, 2, {straight.law, 1}, 0.02, rounding, silent);
  EXPECT_TRUE(rounding.joints.empty());
}

TEST(ContourReport, AxesThatAPlanarContourDoesNotMoveAreNoted) {
  Contour contour;
  contour.height = 2.5;
  ContourPlan plan;
  note_still_axes(contour, {{AxisLimits("x", 1), AxisLimits("y", 1), AxisLimits("w", 1)}, 0.001}, plan);
  ASSERT_EQ(plan.notes.size(), 1u);
  EXPECT_EQ(plan.notes[0], "axis w stands still at 2.5 mm: the contour is planar");
}

}  // namespace
}  // namespace bahnwerk
