#include "core/plan/contour/stopping_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/builder.hpp"
#include "core/motion/axes/axis_path.hpp"
#include "core/plan/planning_method.hpp"
#include "tests/core/plan/contour/verified_plans.hpp"
#include "tests/core/plan/random_contour.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

using test::axes_alike, test::verified_plan;

double least(const Contour& contour, const Machine& machine) {
  const CartesianAxisPath axes(contour.path, machine.dimension());
  return StoppingTime(contour, axes, machine, ContourPlanning{}.corner_angle)
      .least(0, contour.path.size(), silent_scope());
}

// What is not planned because of it has to be certain.
TEST(StoppingTime, IsALowerBoundAndExactOnLines) {
  for (int seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const std::size_t dimension = random.chance(0.7) ? 2 : 3;
    const Contour contour = testing::build(testing::random_outline(random, 1 + random.below(8), dimension));
    Machine m = testing::random_machine(random, dimension);
    for (AxisLimits& axis : m.axes) axis.jerk = axis.acceleration * std::pow(10, random.uniform(0.5, 3));
    for (const PlanningMethod method : {PlanningMethod::time_optimal, PlanningMethod::jerk_limited}) {
      const Machine held = held_limits(m, method_row(method));
      EXPECT_GT(least(contour, held), 0);
      EXPECT_LE(least(contour, held), verified_plan(contour, m, method, 0).duration);
    }
  }
  ContourBuilder b(2, {});
  b.block(Mode::cut, 300);
  for (int i = 1; i < 9; ++i) b.line({0.3 * i * i, i % 2 * 7.0, 0});
  const Contour polygon = b.finish();
  const Machine m = axes_alike(1e6);
  EXPECT_NEAR(least(polygon, m), verified_plan(polygon, m, PlanningMethod::jerk_limited, 0).duration, 1e-8);
}

/// Tangent arcs whose curvature jumps, at a feed: the dips of speed at the joints count.
TEST(StoppingTime, KnowsWhatJointsCost) {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 25);
  Vec at{};
  for (int i = 0; i < 20; ++i) {  // half circles, left and right in turn
    b.arc(at + Vec{10, 0, 0}, at + Vec{5, 0, 0}, i % 2 == 0);
    at = at + Vec{10, 0, 0};
  }
  const Contour contour = b.finish();
  const Machine m = axes_alike(1e4);
  const double at_feed = contour.path.length() / 25, certain = least(contour, m),
               planned = verified_plan(contour, m, PlanningMethod::jerk_limited, 0).duration;
  EXPECT_LE(certain, planned);
  EXPECT_GT(certain - at_feed, 0.3 * (planned - at_feed));
}

}  // namespace
}  // namespace bahnwerk
