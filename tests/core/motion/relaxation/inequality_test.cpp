// One inequality, x ≤ 1: its steps against Newton's equations.
#include "core/motion/relaxation/inequality.hpp"

#include <gtest/gtest.h>

#include "core/numeric/lanes.hpp"

namespace bahnwerk {
namespace {

Inequality<double> some() {
  Inequality<double> i;
  i.slack = 0.7, i.multiplier = 0.3, i.residual = 0.1;
  i.advance(0, 0);
  return i;
}

TEST(Inequality, PredictsAStepToNoComplementarity) {
  Inequality<double> i = some();
  const double change = -0.25;
  i.predict(change);
  const double step = -(0.1 + change);
  EXPECT_NEAR(0.7 * i.multiplier_step + 0.3 * step, -0.7 * 0.3, 1e-15);
  EXPECT_NEAR(i.pending, step * i.multiplier_step, 1e-15);
}

TEST(Inequality, FollowsToTheTargetWithTheProductOfThePredictor) {
  Inequality<double> i = some();
  i.predict(-0.25);
  const double product = 0.75 * i.pending, target = 0.02;
  i.pending = i.aim(target, 0.75);
  i.follow(0.125);
  EXPECT_NEAR(i.pending, -(0.1 + 0.125), 1e-15);  // the slack's step
  EXPECT_NEAR(0.7 * i.multiplier_step + 0.3 * i.pending, target - product - 0.7 * 0.3, 1e-15);
  i.advance(0.5, 0.25);
  EXPECT_NEAR(i.slack, 0.7 - 0.5 * 0.225, 1e-15);
  EXPECT_NEAR(i.inverse * i.slack, 1, 1e-15);
}

TEST(Inequality, TwoSidesAreTwo) {
  Inequality<Lanes<2>> sides;
  sides.slack = Lanes<2>{0.7, 0.5}, sides.multiplier = Lanes<2>{0.3, 0.2}, sides.residual = Lanes<2>{0.1, 0};
  sides.advance(0, 0);
  Inequality<double> one = some();
  sides.predict(Lanes<2>{-0.25, 0.25}), one.predict(-0.25);
  EXPECT_EQ(sides.pending[0], one.pending);
  sides.pending = sides.aim(0.02, 1), one.pending = one.aim(0.02, 1);
  sides.follow(Lanes<2>{0.125, -0.125}), one.follow(0.125);
  EXPECT_EQ(sides.multiplier_step[0], one.multiplier_step);
}

}  // namespace
}  // namespace bahnwerk
