#include "core/plan/coarse_fine/fitted_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/axes/path_task.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/coarse/carried_motion.hpp"
#include "core/verify/redundant/coarse_fine_checks.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

TimeLaw law(std::initializer_list<double> durations) {
  TimeLaw law;
  for (const double d : durations) law.append({0, d, 0, 1, 0, 0, 0, 0});
  return law;
}

std::shared_ptr<const Motion> spline() {
  return std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{0.5, {{1, 0, 3, 2}}}, {1, {{2, 4.5, -4.5 + 1e-9}}}});
}

TEST(FittedMotion, IsSlowedDerivativeByDerivative) {
  const FittedMotion slow(spline(), 2, law({1, 1}), {});
  EXPECT_EQ(slow.duration(), 2);
  const MotionState a = spline()->in_piece(0, 0.3), b = slow.in_piece(0, 0.6);
  EXPECT_NEAR(b[0][0], a[0][0], 1e-15);
  EXPECT_NEAR(b[1][0], a[1][0] / 2, 1e-15);
  EXPECT_NEAR(b[2][0], a[2][0] / 4, 1e-15);
  EXPECT_NEAR(b[3][0], a[3][0] / 8, 1e-15);
  Polynomial p;
  ASSERT_TRUE(slow.polynomial(0, 0, p));
  EXPECT_NEAR(evaluate(p, 0.6), b[0][0], 1e-15);
}

TEST(FittedMotion, BordersThatAreTheSameButForRoundingAreTheLaws) {
  const FittedMotion near(spline(), 1, law({0.5 + 1e-16, 0.5}), {});
  EXPECT_EQ(near.begin(1), law({0.5 + 1e-16, 0.5}).pieces()[1].t0);
  const FittedMotion far(spline(), 1, law({0.5 + 1e-9, 0.5}), {});
  EXPECT_EQ(far.begin(1), 0.5);
}

TEST(FittedMotion, EndsAtRest) {
  const FittedMotion velocity(spline(), 1, law({1}), {}, 1);
  EXPECT_NEAR(velocity.in_piece(1, 1)[1][0], 0, 1e-15);
  EXPECT_EQ(velocity.in_piece(1, 0.5)[1][0], 4.5);
  const FittedMotion both(spline(), 1, law({1}), {}, 2);
  EXPECT_NEAR(both.in_piece(1, 1)[1][0], 0, 1e-14);
  EXPECT_NEAR(both.in_piece(1, 1)[2][0], 0, 1e-13);
  EXPECT_EQ(both.in_piece(1, 0.5)[1][0], 4.5);
  EXPECT_EQ(both.in_piece(1, 0.5)[2][0], spline()->in_piece(1, 0.5)[2][0]);
  EXPECT_EQ(both.final_state()[1][0], 0);
}

/// y follows the tool round an arc of 0.05 mm, 30 m along the path, in more pieces than the law has: what the rounding
/// of the path length does to y is far more than the rounding of y's own velocity.
TEST(FittedMotion, AnAxisThatFollowsATinyArcFarAlongThePathIsContinuousButForTheRoundingOfThePathLength) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, unlimited);
  b.line({30000, 0, 0});
  b.arc({30000, 0.1, 0}, {30000, 0.05, 0}, true);
  const auto path = contour_axes(std::make_shared<const Contour>(b.finish()), 2);
  TimeLaw law;
  // It brakes so that its acceleration passes zero where its direction turns: nothing else may differ there.
  const double arc = path->length() - 30000, a = -2e4, braked = (std::sqrt(1e4 + 2 * a * arc) - 100) / a;
  law.append({0, 300, 0, 30000, 100, 0, 0, 0});
  law.append({0, braked, 30000, path->length(), 100, a, 0, 1});
  std::vector<SplineMotion::Piece> still{{300, {{0}, {0}}}};
  constexpr int parts = 4000;
  for (int i = 1; i <= parts; ++i) still.push_back({i < parts ? 300 + i * braked / parts : law.duration(), {{0}, {0}}});
  const auto head = std::make_shared<const PathMotion>(path, law);
  const auto coarse = std::make_shared<const CarriedMotion>(head, std::make_shared<const SplineMotion>(still),
                                                            std::vector<bool>{false, true});
  const double factor = 1 + 1e-5 / 3;
  const TimeLaw slowed = law.slowed(factor);
  const FittedMotion fitted(coarse, factor, slowed, {});
  const std::vector<AxisLimits> coarse_axes{{"xc", 1e4, 1e9}, {"yc", 1e4, 1e9}};
  std::vector<AxisLimits> fine_axes{{"xf", 1e4, 1e9}, {"yf", 1e4, 1e9}};
  fine_axes[0].lowest = -4e4, fine_axes[0].highest = 4e4;
  fine_axes[1].lowest = fine_axes[1].highest = 0;
  const CoarseFineToVerify input{*path, slowed, fitted, coarse_axes, fine_axes};
  Progress progress;
  for (const Check& check : coarse_fine_checks(input, progress)) {
    if (check.quantity != CheckedQuantity::continuity) continue;
    EXPECT_TRUE(check.passed) << check_name(check) << " " << check.value << " " << check.limit;
  }
}

TEST(FittedMotion, AxesThatStandStillComeLast) {
  const FittedMotion motion(spline(), 1, law({1}), {7});
  ASSERT_EQ(motion.axes(), 2u);
  for (const double t : {0.1, 0.7, 1.0}) {
    const MotionState x = motion.evaluate(t);
    EXPECT_EQ(x[0][1], 7);
    EXPECT_EQ(x[1][1], 0);
  }
  Polynomial p;
  ASSERT_TRUE(motion.polynomial(1, 1, p));
  EXPECT_EQ(p, Polynomial{7});
}

}  // namespace
}  // namespace bahnwerk
