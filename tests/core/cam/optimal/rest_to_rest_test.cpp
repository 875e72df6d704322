#include "core/cam/optimal/rest_to_rest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/cam/optimal/laws.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

MotionLawProblem stroke_within(double stroke, DriveLimits drive) {
  MotionLawProblem problem = testing::rest_to_rest(stroke, 1);
  problem.cycle_duration.reset();
  problem.drive = drive;
  return problem;
}

TEST(RestToRest, MeetsTheSixClosedForms) {
  struct Case {
    DriveLimits drive;
    double duration;
  };
  const double h = 30;
  for (const Case& each : {Case{{771, 25000, 3125000}, h / 771 + 771.0 / 25000 + 25000.0 / 3125000},
                           Case{{unlimited, 25000, 3125000}, 0.008 + std::sqrt(0.008 * 0.008 + 4 * h / 25000)},
                           Case{{100, unlimited, 31250}, h / 100 + 2 * std::sqrt(100.0 / 31250)},
                           Case{{unlimited, unlimited, 3125}, std::cbrt(32 * h / 3125)},
                           Case{{100, 2500, unlimited}, h / 100 + 100.0 / 2500},
                           Case{{unlimited, 2500, unlimited}, 2 * std::sqrt(h / 2500)}}) {
    const auto found = rest_to_rest(stroke_within(h, each.drive));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->bound, each.duration, 1e-12 * each.duration);
    EXPECT_LE(found->duration, each.duration * (std::isfinite(each.drive.jerk) ? 1 + 1e-9 : 1.002));
    EXPECT_LE(found->law.peak(1).value, each.drive.velocity * (1 + 1e-9));
    EXPECT_LE(found->law.peak(2).value, each.drive.acceleration * (1 + 1e-9));
    EXPECT_LE(found->law.peak(3).value, each.drive.jerk * (1 + 1e-9));
    EXPECT_EQ(found->law.piece(0).bernstein.front(), 0);
    EXPECT_EQ(found->law.piece(found->law.pieces() - 1).bernstein.back(), h);
  }
}

/// Positions have too few digits for the accelerations of ramps that last 20 µs: their coefficients are rounded so that
/// no derivative is above its limit, and the duration does not grow by it.
TEST(RestToRest, ShortRampsFarFromZeroMeetTheClosedForm) {
  for (const double v : {37.0, 110.0})
    for (const double a : {350.0, 1234.5}) {
      const double h = 271.3, j = a / 2e-5, duration = h / v + v / a + a / j;
      MotionLawProblem problem = stroke_within(h, {v, a, j});
      problem.points[0].values[0] = testing::fixed(518);
      problem.points[1].values[0] = testing::fixed(518 + h);
      const auto found = rest_to_rest(problem);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->duration, duration, 1e-9 * duration);
      EXPECT_LE(found->law.peak(2).value, a * (1 + 1e-9));
      EXPECT_LE(found->law.peak(3).value, j * (1 + 1e-9));
    }
}

TEST(RestToRest, TheLongestSectionDecidesAndOthersAreStretched) {
  MotionLawProblem problem = stroke_within(30, {100, 2500, 1e5});
  problem.points.insert(problem.points.begin() + 1,
                        testing::point_at(30, {testing::fixed(30), testing::fixed(0), testing::fixed(0)}));
  const auto found = rest_to_rest(problem);
  ASSERT_TRUE(found);
  const double stroke = 30.0 / 100 + 100.0 / 2500 + 2500.0 / 1e5;
  EXPECT_NEAR(found->duration, 3 * stroke, 1e-9);
  EXPECT_EQ(found->law.section_extremes(1, 1).highest.value, 0);  // a dwell
}

TEST(RestToRest, APointThatDoesNotRestHasNoClosedForm) {
  MotionLawProblem problem = stroke_within(30, {100, 2500, 1e5});
  problem.points.back().values[1] = testing::fixed(10);
  EXPECT_FALSE(rest_to_rest(problem));
}

}  // namespace
}  // namespace bahnwerk::cam
