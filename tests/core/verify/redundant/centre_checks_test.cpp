#include "core/verify/redundant/centre_checks.hpp"

#include <gtest/gtest.h>

#include "core/motion/axes/spline_motion.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

SplineMotion line(double from, double to) {
  std::vector<SplineMotion::Piece> pieces(1);
  pieces[0].end = 2, pieces[0].axes = {Polynomial{from, (to - from) / 2}, Polynomial{0}};
  return SplineMotion(std::move(pieces));
}

TEST(CentreChecks, LookAtBothEndsOfTheAxesThatHaveToBeCentred) {
  const std::vector<AxisLimits> axes{AxisLimits("xf", 1), AxisLimits("yf", 1)};
  std::vector<Check> checks = centre_checks(line(3, 10), line(3, 10.5), axes, {true, false});
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(check_name(checks[0]), "centred at start xf");
  EXPECT_TRUE(checks[0].passed);
  EXPECT_EQ(check_name(checks[1]), "centred at end xf");
  EXPECT_FALSE(checks[1].passed);
  EXPECT_NEAR(checks[1].value, 0.5, 1e-12);
  EXPECT_TRUE(centre_checks(line(3, 10), line(0, 0), axes, {false, false}).empty());
}

}  // namespace
}  // namespace bahnwerk
