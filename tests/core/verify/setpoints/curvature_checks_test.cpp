// Chord error and half-speed feed of a sampled motion: closed forms on a circle, and what is too fast is found.
#include "core/verify/setpoints/curvature_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "core/geometry/curve/arc.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

struct Circle {
  static constexpr double radius = 5;
  Path tool;
  TimeLaw law;
  Circle(double v, double angle) {
    tool.append(std::make_shared<Arc>(Vec{}, Vec{1, 0, 0}, Vec{0, 1, 0}, radius, angle, 0), 0);
    law.append({0, tool.length() / v, 0, tool.length(), v, 0, 0, 0});
  }
  std::vector<Check> checks(double tolerance, double half, double velocity) const {
    const CartesianAxisPath path(tool, 2);
    Progress progress;
    return curvature_checks({path, law, 0.002, tolerance, half, velocity}, progress);
  }
};

TEST(CurvatureChecks, ValuesOnACircleAreKnown) {
  const double v = 200;
  const Circle circle(v, 3);
  const auto checks = circle.checks(0.005, 0.2, 400);
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(check_name(checks[0]), "chord error");
  EXPECT_NEAR(checks[0].value, Circle::radius * (1 - std::cos(v * 0.002 / Circle::radius / 2)), 1e-10);
  EXPECT_TRUE(checks[0].passed);
  EXPECT_EQ(check_name(checks[1]), "half-speed feed");
  EXPECT_NEAR(checks[1].value, 2 * v, 1e-9);
  EXPECT_TRUE(checks[1].passed);
  EXPECT_TRUE(circle.checks(unlimited, unlimited, 1).empty());
}

TEST(CurvatureChecks, FindWhatIsTooFast) {
  const Circle circle(230, 3);
  const auto checks = circle.checks(0.005, 0.2, 400);
  EXPECT_FALSE(checks[0].passed);
  EXPECT_FALSE(checks[1].passed);
}

}  // namespace
}  // namespace bahnwerk
