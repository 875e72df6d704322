/// Random contours with corners rounded and jerk limited: every plan is verified, stays in its tube, and is not faster
/// than its bound.
#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/plan/contour/contour_plan.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

class SmoothProperty : public ::testing::TestWithParam<int> {};

TEST_P(SmoothProperty, RoundedAndJerkLimitedPlansAreVerified) {
  const int cases = testing::cases(20);
  for (int n = 0; n < cases; ++n) {
    const int seed = 100'000 + cases * GetParam() + n;
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const std::size_t dimension = random.chance(0.7) ? 2 : 3, longest = random.chance(0.8) ? 12 : 60;
    const auto outline = testing::random_outline(random, 1 + random.below(longest), dimension);
    Machine machine = testing::random_machine(random, dimension);
    for (AxisLimits& axis : machine.axes) axis.jerk = axis.acceleration * std::pow(10, random.uniform(0.5, 3));
    ContourPlanning planning;
    const double tolerance = std::pow(10, random.uniform(-3, 0));
    Progress progress;
    const auto plan = [&](PlanningMethod method, CornerMode corner) {
      planning.method = method;
      planning.corner_mode = corner;
      planning.blend_tolerance = corner == CornerMode::blend ? tolerance : 0;
      ContourPlan result = plan_contour(testing::build(outline), machine, planning, progress);
      EXPECT_TRUE(result.verification.passed);
      for (const Check& check : result.verification.checks) {
        EXPECT_TRUE(check.passed) << check_name(check) << ' ' << check.value << " against " << check.limit;
        if (check_name(check) == "deviation from contour") {
          EXPECT_LE(check.value, planning.blend_tolerance);
        }
      }
      EXPECT_EQ(check_name(result.verification.checks.back()) == "deviation from contour", corner == CornerMode::blend);
      EXPECT_GE(result.bound.gap, 0);
      return result.duration;
    };
    // Corners are rounded for what the machine can use, so the two blended paths differ; the stopped ones do not.
    plan(PlanningMethod::time_optimal, CornerMode::blend);
    plan(PlanningMethod::jerk_limited, CornerMode::blend);
    const double quick = plan(PlanningMethod::time_optimal, CornerMode::stop);
    EXPECT_GE(plan(PlanningMethod::jerk_limited, CornerMode::stop), quick * (1 - 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(Shard, SmoothProperty, ::testing::Range(0, 4));

}  // namespace
}  // namespace bahnwerk
