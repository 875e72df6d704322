// Fifty equal holes take as long as each of them alone, and every one is verified.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/law/block_times.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/motion/sheet.hpp"

namespace bahnwerk {
namespace {

const Machine m{{{"x", 1800, 16000, 1e6}, {"y", 1500, 9000, 5e5}}, 0.001};

ContourPlan plan(const Contour& contour, PlanningMethod method) {
  ContourPlanning planning;
  planning.method = method;
  Progress progress;
  ContourPlan plan = plan_contour(contour, m, planning, progress);
  EXPECT_TRUE(plan.verification.passed);
  EXPECT_GE(plan.duration, plan.bound.value * (1 - 1e-9));
  return plan;
}

void expect_alike(test::Hole hole, PlanningMethod method) {
  constexpr int n = 50;
  const ContourPlan sheet = plan(test::sheet(hole, 0, n), method);
  ASSERT_EQ(sheet.blocks.size(), 2u * n - 1);
  for (const int i : {0, 1, 17, n - 1}) {
    const ContourPlan one = plan(test::sheet(hole, i, i + 1), method);
    // Blocks' times are those of the motion that is sampled, slowed to whole cycles.
    const BlockReport &of_sheet = sheet.blocks[2 * static_cast<std::size_t>(i)], &first = sheet.blocks[0];
    EXPECT_NEAR(of_sheet.end_time - of_sheet.start_time, first.end_time - first.start_time, 1e-9);
    // Alone a hole may be planned on a finer grid than among moves that have no gap: that is worth 5e-6. Under limits
    // of jerk rounding of the coordinates shows in a method that stops at a gap of 1e-4.
    const double same = method == PlanningMethod::jerk_limited ? 1e-5 : 5e-6;
    EXPECT_NEAR(sheet.cut_time, n * one.duration, same * sheet.cut_time) << i;
  }
}

TEST(RepeatedSections, EachHoleTakesAsLongAsAlone) {
  for (const PlanningMethod method :
       {PlanningMethod::braking_reserve, PlanningMethod::time_optimal, PlanningMethod::jerk_limited})
    for (const test::Hole hole : {test::Hole::circle, test::Hole::slot, test::Hole::free_form})
      expect_alike(hole, method);
}

// On the same grid: to rounding.
TEST(RepeatedSections, TheLawIsThatOfOneHole) {
  Progress progress;
  for (const test::Hole hole : {test::Hole::circle, test::Hole::slot, test::Hole::free_form}) {
    constexpr int n = 50;
    const auto planned = [&](int first, int last) {
      return plan_acceleration_limited(test::sheet(hole, first, last), m, {}, progress).law;
    };
    const TimeLaw all = planned(0, n);
    const std::vector<BlockTime> times = block_times(test::sheet(hole, 0, n), all);
    for (const int i : {0, 1, 17, n - 1}) {
      const BlockTime& block = times[2 * static_cast<std::size_t>(i)];
      EXPECT_NEAR(block.end - block.begin, planned(i, i + 1).duration(), 1e-10) << i;
    }
  }
}

TEST(RepeatedSections, TheSameTwiceOver) {
  const Contour contour = test::sheet(test::Hole::slot, 0, 20);
  const ContourPlan one = plan(contour, PlanningMethod::jerk_limited),
                    two = plan(contour, PlanningMethod::jerk_limited);
  EXPECT_EQ(one.duration, two.duration);
  EXPECT_EQ(one.bound.value, two.bound.value);
}

}  // namespace
}  // namespace bahnwerk
