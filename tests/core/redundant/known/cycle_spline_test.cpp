#include "core/redundant/known/cycle_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(CycleSpline, HasAContinuousAccelerationWhosePeaksAreDifferencesOfControlPoints) {
  Random random(3);
  const double h = 0.002;
  std::vector<double> c(60, 5);
  for (std::size_t i = 3; i + 3 < c.size(); ++i) c[i] = random.uniform(0, 10);
  for (std::size_t i = c.size() - 3; i < c.size(); ++i) c[i] = 8;
  const SplineMotion spline = cycle_spline({c}, h);
  EXPECT_DOUBLE_EQ(spline.duration(), h * 59);
  double velocity = 0, acceleration = 0;
  for (std::size_t i = 0; i < spline.pieces(); ++i) {
    if (i > 0) {
      const MotionState a = spline.in_piece(i - 1, spline.begin(i)), b = spline.in_piece(i, spline.begin(i));
      EXPECT_NEAR(a[0][0], b[0][0], 1e-12);
      EXPECT_NEAR(a[1][0], b[1][0], 1e-9);
      EXPECT_NEAR(a[2][0], b[2][0], 1e-6);
    }
    for (const double at : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      const MotionState x = spline.in_piece(i, spline.begin(i) + at * h);
      velocity = std::fmax(velocity, std::abs(x[1][0]));
      acceleration = std::fmax(acceleration, std::abs(x[2][0]));
    }
  }
  double most_first = 0, most_second = 0;
  for (std::size_t i = 1; i < c.size(); ++i) {
    most_first = std::fmax(most_first, std::abs(c[i] - c[i - 1]) / h);
    if (i > 1) most_second = std::fmax(most_second, std::abs(c[i] - 2 * c[i - 1] + c[i - 2]) / (h * h));
  }
  EXPECT_LE(velocity, most_first * (1 + 1e-9));
  EXPECT_NEAR(acceleration, most_second, 1e-6 * most_second);
  for (const MotionState& x : {spline.in_piece(0, 0), spline.final_state()}) {
    EXPECT_NEAR(x[1][0], 0, 1e-10);
    EXPECT_NEAR(x[2][0], 0, 1e-6);
  }
  EXPECT_EQ(spline.in_piece(0, 0)[0][0], 5);
  EXPECT_NEAR(spline.final_state()[0][0], 8, 1e-13);
}

TEST(CycleSpline, TakesFourControlPointsAtLeast) {
  EXPECT_THROW(cycle_spline({{1, 1, 1}}, 1), std::invalid_argument);
  EXPECT_THROW(cycle_spline({}, 1), std::invalid_argument);
}

TEST(CycleSpline, SamplesIncludeBothEnds) {
  const SplineMotion line({{2, {{1, 3}}}});
  EXPECT_EQ(sampled(line, 2), (std::vector<std::vector<double>>{{1, 4, 7}}));
}

}  // namespace
}  // namespace bahnwerk
