#include "core/redundant/known/lag_compensation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/redundant/known/filters.hpp"
#include "tests/core/redundant/known/known_plans.hpp"

namespace bahnwerk {
namespace {

using test::expect_valid, test::plan;

TEST(KnownMethods, OvershootAndCirclesOfTheCompensatedLag) {
  for (const double fine : {0.001, 0.004, 0.015}) {
    const double coarse = 0.02;
    double most = 0;  // of 1 − e(t), e as in the corrected step response
    for (double t = 0; t < 0.5; t += 1e-6)
      most = std::fmax(most, (fine * std::exp(-t / coarse) - coarse * std::exp(-t / fine)) / (coarse - fine));
    EXPECT_NEAR(step_overshoot(coarse, fine), most, 1e-9);
    EXPECT_GT(circle_gain(coarse, fine, 40, false), 1);
    EXPECT_LT(circle_gain(coarse, fine, 40, true), 1);
    EXPECT_NEAR(circle_gain(coarse, fine, 40, true), 1 / std::hypot(1, 40 * fine), 1e-15);
  }
}

/// The simulated tool goes round a circle as its transfer function says.
TEST(KnownMethods, ASimulatedCircleGrowsByTheGainOfTheTransferFunction) {
  ContourBuilder b(2, {10, 0, 0});
  b.block(Mode::cut, 300);
  for (int i = 0; i < 6; ++i) b.arc({10, 0, 0}, {0, 0, 0}, true);
  const RedundancyTask task = test::redundancy_task(b.finish(), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::lag_compensation);
  expect_valid(task, r);
  ASSERT_EQ(r.lags.size(), 2u);
  const double grown = 10 * (circle_gain(0.02, 0.002, 30, false) - 1),
               shrunk = 10 * (1 - circle_gain(0.02, 0.002, 30, true));
  EXPECT_GE(r.lags[0].contour_error, grown * 0.99);
  EXPECT_GE(r.lags[1].contour_error, shrunk * 0.99);
  EXPECT_LT(r.lags[1].contour_error, r.lags[0].contour_error);
}

/// The discrete prefilter answers a motion as its transfer function does: less the share T_f/T_c of the coarse lag.
TEST(KnownMethods, ThePrefilterTakesOffItsShareOfTheCoarseLag) {
  const double coarse = 0.02, fine = 0.003, step = 0.001;
  std::vector<double> x;
  for (int i = 0; i < 200; ++i) x.push_back(i < 50 ? 0 : std::sin(0.05 * (i - 50)) + 0.01 * (i - 50));
  const std::vector<double> lag = lagged(x, coarse, step);
  const Prefilter v = prefilter(coarse, fine, step);
  double y = x[0];
  for (std::size_t i = 1; i < x.size(); ++i) {
    y = v.b[0] * x[i] + v.b[1] * x[i - 1] - v.a1 * y;
    EXPECT_NEAR(y, x[i] - fine / coarse * (x[i] - lag[i]), 1e-12);
  }
  EXPECT_NEAR((v.b[0] + v.b[1]) / (1 + v.a1), v.numerator[0] / v.denominator[0], 1e-12);  // at rest
}

}  // namespace
}  // namespace bahnwerk
