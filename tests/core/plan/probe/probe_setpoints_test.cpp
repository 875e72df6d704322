#include "core/plan/probe/probe_setpoints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace bahnwerk {
namespace {

TEST(ProbeSetpoints, RowsKnowTheEdgeThatIsPassedAndEndOnTheLastPoint) {
  auto problem = std::make_shared<ProbeProblem>();
  problem->points = {{0, 0}, {2, 0}, {2, 2}};
  for (const char* name : {"x", "y"}) problem->machine.axes.push_back(AxisLimits(name, 100, 1000));
  problem->machine.cycle_time = 0.25;
  ProbeMotion motion;  // past the corner by 0.5 mm, then up
  motion.motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{1, {{0, 2.5}, {0, 0, 0, 1e-3}}}, {2, {{2.5, -0.5}, {1e-3, 2 - 1e-3}}}});
  motion.times = {0, 0.9, 2};
  const ProbeSetpoints rows(problem, motion, 8);
  const char* names[] = {"x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "deviation", "v"};
  ASSERT_EQ(rows.columns().size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(rows.columns()[i].name, names[i]);
  double row[10];
  rows.read(3, 1, row);  // 0.75 s, on the first edge
  EXPECT_DOUBLE_EQ(row[0], 1.875);
  EXPECT_NEAR(row[7], 6e-3, 1e-15);
  EXPECT_NEAR(row[8], 1e-3 * 0.75 * 0.75 * 0.75, 1e-15);
  EXPECT_NEAR(row[9], 2.5, 1e-5);
  rows.read(4, 1, row);  // 1 s: the second one
  EXPECT_NEAR(row[8], 0.5, 1e-12);
  EXPECT_NEAR(row[9], std::hypot(0.5, 1.999), 1e-12);
  rows.read(8, 1, row);
  EXPECT_EQ(row[0], 2);
  EXPECT_EQ(row[1], 2);
  for (std::size_t i = 2; i < 8; ++i) EXPECT_EQ(row[i], 0);
  EXPECT_EQ(row[8], 0);
}

}  // namespace
}  // namespace bahnwerk
