#include "core/plan/planning_method.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(PlanningMethods, EachHasARow) {
  for (const auto& method : planning_methods) {
    EXPECT_EQ(method_row(method.value).method, method.value) << method.name;
    EXPECT_NE(method_row(method.value).plan, nullptr) << method.name;
  }
  EXPECT_EQ(method_row(PlanningMethod::time_optimal).refinement, Refinement::to_bound);
}

TEST(PlanningMethods, ATrapezoidLimitsNoJerkWhereTheProfileDecides) {
  MethodOptions options;
  options.profile = SpeedProfile::trapezoid;
  EXPECT_EQ(method_row(PlanningMethod::constant, options).order, 2);
  EXPECT_EQ(method_row(PlanningMethod::critical_points, options).order, 2);
  EXPECT_EQ(method_row(PlanningMethod::jerk_limited, options).order, 3) << "it has no profile";
  options.profile = SpeedProfile::double_s;
  EXPECT_EQ(method_row(PlanningMethod::constant, options).order, 3);
}

TEST(PlanningMethods, JerkLimitsAreHeldByMethodsThatKnowJerk) {
  const Machine machine{{AxisLimits("x", 1, 2, 3), AxisLimits("y", 1, 2, 4), AxisLimits("z", 1, 2, 5)}, 0.001};
  const Machine held = held_limits(machine, method_row(PlanningMethod::jerk_limited)),
                free = held_limits(machine, method_row(PlanningMethod::braking_reserve));
  EXPECT_EQ(held.axes[1].jerk, 4);
  ASSERT_EQ(free.axes.size(), 3u);
  EXPECT_EQ(free.axes[2].jerk, unlimited);
  EXPECT_EQ(free.axes[2].acceleration, 2);
}

}  // namespace
}  // namespace bahnwerk
