/// Random contours and limits: every plan is verified, within its bound, and behaves as physics says.
/// 2 000 cases in eight shards.
#include "core/plan/contour/contour_plan.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/plan/random_contour.hpp"

namespace bahnwerk {
namespace {

using testing::Outline;

class PlanProperty : public ::testing::TestWithParam<int> {
 protected:
  /// A Machine by value: the plan must not hang on anything of ours.
  static ContourPlan plan(const Outline& outline, const Machine& machine, PlanningMethod method) {
    Progress progress;
    ContourPlanning planning;
    planning.method = method;
    planning.braking_reserve = 0.7;
    return plan_contour(build(outline), machine, planning, progress);
  }
  static std::string failures(const ContourPlan& p) {
    std::string text;
    for (const Check& c : p.verification.checks)
      if (!c.passed)
        text += check_name(c) + " limit " + std::to_string(c.limit) + " value " + std::to_string(c.value) + " at " +
                std::to_string(c.at) + "; ";
    return text;
  }
};

/// Mostly a few segments, now and then up to 200.
std::size_t segment_count(Random& random) {
  const double pick = random.uniform();
  const std::uint64_t most = pick < 0.9 ? 2 : pick < 0.995 ? 8 : 200;
  return 1 + static_cast<std::size_t>(random.below(most));
}

TEST_P(PlanProperty, VerifiedBoundedMonotoneReversibleDivisibleScalable) {
  Random random(1000 + static_cast<std::uint64_t>(GetParam()));
  for (std::size_t i = 0; i < testing::cases(std::size_t{250}); ++i) {
    SCOPED_TRACE("shard " + std::to_string(GetParam()) + " case " + std::to_string(i));
    const std::size_t dimension = random.chance(0.25) ? 3 : 2;
    const Outline outline = testing::random_outline(random, segment_count(random), dimension);
    const Machine machine = testing::random_machine(random, dimension);

    ContourPlan fast;
    ASSERT_NO_THROW(fast = plan(outline, machine, PlanningMethod::time_optimal));
    ASSERT_TRUE(fast.verification.passed) << failures(fast);
    ASSERT_GE(fast.bound.gap, 0);
    ASSERT_LE(fast.bound.gap, 1e-4);
    ASSERT_GE(fast.setpoints->duration(), fast.duration);
    ASSERT_LT(fast.setpoints->duration(), fast.duration + machine.cycle_time);

    switch (i % 5) {
      case 0: {
        const ContourPlan reserve = plan(outline, machine, PlanningMethod::braking_reserve);
        ASSERT_TRUE(reserve.verification.passed) << failures(reserve);
        // Each is as close to what it can reach as the pipeline asks for.
        ASSERT_LE(fast.duration, reserve.duration * (1 + 1e-6));
        break;
      }
      case 1: {  // looser limits never take longer
        Machine loose = machine;
        const std::size_t axis = random.below(dimension);
        (random.chance(0.5) ? loose.axes[axis].velocity : loose.axes[axis].acceleration) *= random.uniform(1, 2);
        ASSERT_LE(plan(outline, loose, PlanningMethod::time_optimal).duration, fast.duration * (1 + 1e-5));
        break;
      }
      case 2: {
        const double backwards = plan(testing::reversed(outline), machine, PlanningMethod::time_optimal).duration;
        ASSERT_NEAR(backwards, fast.duration, 1e-5 * fast.duration);
        break;
      }
      case 3: {
        const double cut = plan(testing::divided(outline, random), machine, PlanningMethod::time_optimal).duration;
        ASSERT_NEAR(cut, fast.duration, 1e-5 * fast.duration);
        break;
      }
      default: {  // another unit of length
        Machine other = machine;
        for (AxisLimits& a : other.axes) {
          a.velocity *= 1024;
          a.acceleration *= 1024;
        }
        ASSERT_NEAR(plan(testing::scaled(outline, 1024), other, PlanningMethod::time_optimal).duration, fast.duration,
                    1e-6 * fast.duration);
      }
    }
  }
}

/// Roundings of corners that turn by a few µrad bend far less than the axes' velocities let matter: what of their
/// curvature is rounding must not ask for cells.
TEST(ContourPlan, CornersThatHardlyTurnTakeFewPieces) {
  ContourBuilder b(2, {-8.0272, 62.5314, 0});
  b.block(Mode::position, unlimited);
  for (const Vec to : {Vec{-4.4923, 75.2085, 0}, Vec{-3.3127, 79.4389, 0}, Vec{-2.6031, 81.9836, 0},
                       Vec{-0.7492, 88.6319, 0}, Vec{2.6187, 100.7094, 0}})
    b.line(to);
  const Contour contour = b.finish();
  Machine machine;
  machine.axes = {{"x", 1103.08, 3619.36}, {"y", 70.76, 19903.2}};
  machine.cycle_time = 0.0007;
  ContourPlanning planning;
  planning.corner_mode = CornerMode::blend;
  planning.blend_tolerance = 0.0677;
  for (const PlanningMethod method : {PlanningMethod::braking_reserve, PlanningMethod::time_optimal}) {
    planning.method = method;
    const ContourPlan plan = plan_contour(contour, machine, planning);
    EXPECT_TRUE(plan.verification.passed);
    EXPECT_LE(plan.pieces, 1000u);
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, PlanProperty, ::testing::Range(0, 8));

}  // namespace
}  // namespace bahnwerk
